// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "plugins/controller/common/stream/endpoint.hpp"
#include "plugins/controller/common/stream/timed_line.hpp"

namespace muro::stream {

/// The steps' view of an open stream.
class LiveStream {
 public:
  /// Opens the stream and writes the actual port to the address. `lockstep` may be null. Throws muro::Error.
  LiveStream(const std::string& name, Address& address, const Framing& framing, const Limits& limits, Host& host,
             LockstepStream* lockstep);
  LiveStream(const LiveStream&) = delete;
  LiveStream& operator=(const LiveStream&) = delete;
  ~LiveStream();

  /// Begins a step. Returns false when the client for which time waits sent nothing in time.
  bool begin(std::int64_t time) { return begin(time, true); }
  /// Begins a step without waiting.
  void poll(std::int64_t time) { static_cast<void>(begin(time, false)); }
  const Event* next();
  bool send(std::uint32_t client, std::string_view bytes) { return send(client, bytes, limits_.output_bytes); }
  bool send(std::uint32_t client, std::string_view bytes, std::size_t most);
  std::size_t waiting(std::uint32_t client) const {
    return address_.is_timed ? output_.waiting() : exchange_.waiting(client);
  }
  void send_to_all(std::string_view bytes);
  void hold(std::uint32_t client, bool held) {
    if (exchange_.hold(client, held)) io_->signal(connections_);
  }
  void answered();
  void disconnect(std::uint32_t client);
  void set_baud(std::uint32_t baud);
  Statistics statistics() const { return exchange_.statistics(); }

 private:
  bool begin(std::int64_t time, bool waits);
  void collect();
  void set_due();
  void send_what_has_passed();
  bool send_timed(std::string_view bytes, std::size_t most);
  bool wake(Exchange::Sent sent);
  bool has_message() const;
  bool is_read_through() const { return next_ == inbox_.entries.size(); }

  const Address& address_;
  const Limits limits_;
  LockstepStream* const lockstep_;
  const std::shared_ptr<IoThread> io_;
  Exchange exchange_;
  Connections connections_;
  std::unique_ptr<Endpoint> endpoint_;

  std::int64_t time_ = 0;
  Inbox inbox_;
  std::size_t next_ = 0;  ///< index of the next entry of `inbox_`
  /// In lockstep a step has one message at most: the number that has come already depends on the wall clock.
  bool has_handed_out_message_ = false;
  Event event_;

  // used when bytes take time
  TimedLine input_;
  std::vector<std::int64_t> due_;  ///< instants (ns) at which the first entries of `inbox_` take effect
  OutputLine output_;
  std::uint32_t listener_ = 0;  ///< the client at the other end
  bool is_ending_ = false;      ///< it is disconnected when all bytes have passed
};

}  // namespace muro::stream
