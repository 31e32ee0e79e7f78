// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <functional>

#include "plugins/controller/common/stream/io_thread.hpp"

namespace muro::stream {

/// Makes an attempt again later, unless it is stopped before. [I/O thread]
class Retry {
 public:
  Retry(IoThread& io, std::function<void()> attempt) : timer_(io.context()), attempt_(std::move(attempt)) {}
  /// Schedules the attempt. Replaces an attempt that was scheduled before.
  void later(std::chrono::nanoseconds delay = std::chrono::milliseconds(250)) {
    timer_.expires_after(delay);
    timer_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled && !is_stopped_) attempt_();
    });
  }
  void stop() {
    is_stopped_ = true;
    timer_.cancel();
  }
  bool is_stopped() const { return is_stopped_; }

 private:
  asio::steady_timer timer_;
  const std::function<void()> attempt_;
  bool is_stopped_ = false;
};

}  // namespace muro::stream
