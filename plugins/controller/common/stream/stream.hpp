// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "muro/ext/external_inputs.hpp"
#include "muro/ext/lockstep.hpp"
#include "plugins/controller/common/stream/address.hpp"

namespace muro::stream {

/// How bytes become messages. Runs in the thread of input and output.
struct Framing {
  /// How many of `bytes` (one or more, from the begin of a message) are the first message with its terminator. 0: it is
  /// not complete. `invalid`: this is no message of the protocol; the client is disconnected and counted. Null: bytes
  /// are handed on as they come.
  static constexpr std::size_t invalid = ~std::size_t(0);
  std::size_t (*size_of_first)(std::string_view bytes, bool is_first_of_client) = nullptr;
  /// Bytes; a message that gets longer without an end is handed on as it is by `keep`, or its client is disconnected.
  std::size_t longest = 65536;
  bool keeps_too_long = false;
};

/// Lines that end by LF, CR or both, of which a message has the first.
std::size_t line_size(std::string_view bytes, bool is_first_of_client);

/// What has come in, in its order.
struct Event {
  enum class Kind : std::uint32_t { connected, message, disconnected };
  Kind kind = Kind::message;
  std::uint32_t client = 0;  ///< a number that is not used twice in a run
  std::string_view bytes;    ///< of a message; good until the next call
};

/// For the report, since the begin of the run.
struct Statistics {
  std::uint64_t clients = 0;  ///< that connected
  std::uint64_t refused = 0;  ///< connections above the bound
  std::uint64_t messages = 0, bytes_in = 0, bytes_out = 0;
  std::uint64_t dropped = 0;       ///< replies that a client did not take in time: its buffer was full
  std::uint64_t disconnected = 0;  ///< clients that were disconnected: what they sent was no message
  std::uint64_t lost = 0;          ///< clients that broke off, in a message or by a reset
  std::uint64_t held_back = 0;     ///< times a client was not read from, because too much of it waited for a step
};

struct Limits {
  std::size_t input_messages = 1024;   ///< of a client that wait for the next step; then no more is read from it
  std::size_t output_bytes = 1 << 20;  ///< of a client that wait to be sent; then replies are dropped whole
  std::size_t input_bytes = 1 << 20;   ///< as input_messages
  /// Events are recorded, and a replay has them again. False: whoever takes them has their effects recorded by others,
  /// and in a replay there are none.
  bool is_recorded = true;
  /// A client that has said that it says no more is disconnected as soon as a step knows. True: whoever serves it
  /// disconnects it, when all that it has said is answered.
  bool has_late_replies = false;
};

/// One stream with its clients: a server, a client, a pseudo-terminal or a serial device, or a recording of it.
///
/// Input and output run in a thread that all streams of the plugin share; none of the functions waits for a client,
/// but `begin` in lockstep. All are called by an algorithm that runs alone (Capability::runs_alone), so that what comes
/// from outside has an order. Messages that arrive in between take effect in the next step.
class Stream {
 public:
  /// `name`: of the stream within the scenario, "rovers_3/laser". `owner`: for log lines, as `name`. [setup]
  Stream(Connector& connector, std::string name, Address address, Framing framing, Limits limits = {});
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream();

  /// Opens it, unless it is open or a recording stands in for it, or the scenario is only looked at. Throws muro::Error
  /// with the reason of the system: the port is taken, the path cannot be written. [start]
  void open();

  /// Begins a step at `time` (ns): in lockstep, waits for the client, and the step has one message at most. Throws
  /// muro::Error when it did not answer in time and the address says that this ends the run. [step]
  void begin(std::int64_t time);
  /// The same without waiting for anybody: while the run is paused, at `time`. [between steps]
  void poll(std::int64_t time);
  /// The next event of this step. Null: there is no other. [step]
  const Event* next();
  /// Sends to one client, or drops all of it where the client has too much waiting. Never waits. False: dropped, which
  /// no state may depend on. [step]
  bool send(std::uint32_t client, std::string_view bytes);
  /// Drops them, and counts them, where more than `most` bytes would wait: the rest of the buffer is for others. [step]
  bool send(std::uint32_t client, std::string_view bytes, std::size_t most);
  /// Bytes that were sent to the client and have not gone out. [step]
  std::size_t waiting(std::uint32_t client) const;
  /// To every client. [step]
  void send_to_all(std::string_view bytes);
  /// What more the client says stays with it, until `held` is false, but for what has been read already: as much as a
  /// step takes, twice. [step]
  void hold(std::uint32_t client, bool held);
  /// A message was answered for good, or needs no answer: for lockstep, once for each message. [step]
  void answered();
  /// Measurements keep coming without being asked for one by one: for lockstep. [step]
  void set_subscribed(bool subscribed);
  /// Ends the connection once what was sent has gone out. [step]
  void disconnect(std::uint32_t client);
  /// Bit rate from now on, of a serial device and where the address is timed; 0: as at the start. What was sent before
  /// goes out of a serial device at the rate before; of a timed stream what has not passed goes on at the new one.
  /// [step]
  void set_baud(std::uint32_t baud);

  /// For Algorithm::finish(): puts the counts into the report, and warns of what was dropped or refused. [finish]
  void finish();

  bool is_replayed() const;
  const Address& address() const;  ///< with the port that it has, once open
  const std::string& name() const;
  Statistics statistics() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace muro::stream
