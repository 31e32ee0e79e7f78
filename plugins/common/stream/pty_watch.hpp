// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>

#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <map>
#include <vector>

#include "plugins/common/stream/io_thread.hpp"

namespace muro::stream {

/// Looks, 50 times a second, whether a client has opened one of the pseudo-terminals that have none: the system wakes
/// nobody for that. One system call for all of them, and none while all have a client.
class PtyWatch {
 public:
  static std::shared_ptr<PtyWatch> shared(IoThread& io);
  explicit PtyWatch(IoThread& io) : timer_(io.context()) {}

  /// Calls `opened` once, soon after the terminal behind this master has been opened, though it may be closed again
  /// with something said. [I/O thread]
  void wait(int master, std::function<void()> opened);
  void forget(int master);  ///< [I/O thread]

 private:
  void look_later();
  void look();

  asio::steady_timer timer_;
  bool is_waiting_ = false;
  std::map<int, std::function<void()>> opened_;
  std::vector<pollfd> masters_;
};

/// Whether a client has the terminal behind a master open.
bool has_client(int master);

}  // namespace muro::stream
