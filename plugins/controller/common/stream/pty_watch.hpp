// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>

#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <map>
#include <vector>

#include "plugins/controller/common/stream/io_thread.hpp"

namespace muro::stream {

/// Finds out when a client opens one of the pseudo-terminals that have none. A master is not told; so this watches the
/// folder of the terminals, and looks at all masters when somebody has opened something there, and once a second.
/// Where folders cannot be watched, it looks 50 times a second. Who has waited lets go of it in the I/O thread.
class PtyWatch : public std::enable_shared_from_this<PtyWatch> {
 public:
  static std::shared_ptr<PtyWatch> shared(IoThread& io);
  explicit PtyWatch(IoThread& io);

  /// Calls `opened` once, soon after the terminal behind this master has been opened, though it may be closed again
  /// with something said. [I/O thread]
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

/// Whether a client has the terminal behind a master open.
bool has_client(int master);

}  // namespace muro::stream
