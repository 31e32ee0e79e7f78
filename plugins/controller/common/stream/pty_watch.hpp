// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>

#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <map>
#include <vector>

#include "plugins/controller/common/stream/io_thread.hpp"

namespace muro::stream {

/// Detects when a client opens a pseudo-terminal that has no client. The system does not notify the master. So this
/// class watches the folder of the terminals. It checks all masters when something was opened there, and once a second.
/// When folders cannot be watched, it checks 50 times a second. An owner releases it in the I/O thread.
class PtyWatch : public std::enable_shared_from_this<PtyWatch> {
 public:
  static std::shared_ptr<PtyWatch> shared(IoThread& io);
  explicit PtyWatch(IoThread& io);

  /// Calls `opened` once, soon after the terminal of this master was opened. The client may have sent bytes and closed
  /// it again by then. [I/O thread]
  void wait(int master, std::function<void()> opened);
  void forget(int master);  ///< [I/O thread]

 private:
  void look_later();
  void look_when_told();
  void look();

  asio::steady_timer timer_;
  asio::posix::stream_descriptor folder_;
  bool has_timer_ = false, is_told_ = false;
  std::map<int, std::function<void()>> opened_;
  std::vector<pollfd> masters_;
};

/// Whether a client has the terminal of a master open.
bool has_client(int master);

}  // namespace muro::stream
