// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>

#include "plugins/controller/common/stream/exchange.hpp"
#include "plugins/controller/common/stream/io_thread.hpp"
#include "plugins/controller/common/stream/tls.hpp"

namespace muro::stream {

/// Input and output of one client. [I/O thread]
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  enum class Descriptor : std::uint8_t { socket, terminal };
  /// Takes ownership of the descriptor. `closed`: called once after the descriptor was closed, but not by close().
  /// `tls`: null when the connection is not encrypted.
  Connection(IoThread& io, Exchange& exchange, const Framing& framing, std::shared_ptr<Client> client, int descriptor,
             Descriptor kind, std::unique_ptr<TlsSession> tls, std::function<void(Connection&)> closed);

  void start() { read(); }
  /// Handles a signal of the steps: sends waiting bytes, and reads on if it had stopped for lack of room.
  void attend();
  /// Sends the bytes that can be sent at once, then closes the descriptor.
  void close();
  /// Whether the client sends nothing any more. Bytes for the client may still be on their way.
  bool is_silent() const { return is_silent_; }
  /// Whether bytes were taken from the steps and are not written yet.
  bool has_output() const { return is_writing_; }
  /// Whether this side has disconnected the client.
  bool was_ended() const { return is_ending_; }

 private:
  void read();
  void make_room();
  void take_in(std::size_t bytes);
  void take_encrypted(std::size_t bytes);
  bool decrypt();
  void take_end();
  bool take_messages();
  std::size_t next_message();
  void write();
  bool take_output();
  void count_sent(std::size_t bytes);
  void end_input();
  void break_off();
  void fail();
  void end_output();
  void send_now();
  void release();

  Exchange& exchange_;
  const Framing framing_;
  const std::shared_ptr<Client> client_;
  asio::posix::stream_descriptor stream_;
  asio::steady_timer deadline_;
  const Descriptor kind_;
  const std::unique_ptr<TlsSession> tls_;
  const std::unique_ptr<char[]> encrypted_;  ///< received bytes before decryption, when there is TLS
  std::function<void(Connection&)> closed_;

  const std::size_t capacity_;
  const std::unique_ptr<char[]> input_;
  std::size_t begin_ = 0, end_ = 0;  ///< received bytes that are in no message yet
  char skipped_ = 0;                 ///< second half of a line's end, which may follow: CR or LF
  bool is_first_ = true;
  bool is_reading_ = false;
  bool is_full_ = false;    ///< whether it waits for room
  bool has_ended_ = false;  ///< whether the client has closed its side
  bool is_silent_ = false;
  bool is_ending_ = false;  ///< whether the steps have ended the connection
  bool is_closed_ = false;

  std::string output_;
  std::size_t output_sent_ = 0;
  std::string plain_;  ///< the bytes that `output_` holds encrypted
  bool is_writing_ = false;
  bool is_output_ended_ = false;
};

}  // namespace muro::stream
