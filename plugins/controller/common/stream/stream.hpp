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

/// Rules that divide bytes into messages. Run in the I/O thread.
struct Framing {
  /// Returns the size of the first message in `bytes`, with its terminator. `bytes` has one or more bytes and starts at
  /// the begin of a message. Returns 0 when the message is not complete, and `invalid` when it is no message of the
  /// protocol: the client is then disconnected and counted. A null pointer: bytes are passed on as they come.
  static constexpr std::size_t invalid = ~std::size_t(0);
  std::size_t (*size_of_first)(std::string_view bytes, bool is_first_of_client) = nullptr;
  /// Longest message, bytes. A longer one is passed on as it is if `keeps_too_long`, else its client is disconnected.
  std::size_t longest = 65536;
  bool keeps_too_long = false;
};

/// Returns the size of the first line. Lines end with LF, CR or both; a message includes only the first of the two.
std::size_t line_size(std::string_view bytes, bool is_first_of_client);

/// An event of a client. Events are given in their order.
struct Event {
  enum class Kind : std::uint32_t { connected, message, disconnected };
  Kind kind = Kind::message;
  std::uint32_t client = 0;  ///< a number that is not used twice in a run
  std::string_view bytes;    ///< bytes of a message; valid until the next call
};

/// Counts since the begin of the run, for the report.
struct Statistics {
  std::uint64_t clients = 0;  ///< clients that connected
  std::uint64_t refused = 0;  ///< connections above the bound
  std::uint64_t messages = 0, bytes_in = 0, bytes_out = 0;
  std::uint64_t dropped = 0;       ///< replies that a client did not read in time: its buffer was full
  std::uint64_t disconnected = 0;  ///< clients that were disconnected because they sent no valid message
  std::uint64_t lost = 0;          ///< clients whose connection broke, in a message or by a reset
  std::uint64_t held_back = 0;     ///< how often reading from a client stopped: too much of it waited for a step
};

struct Limits {
  std::size_t input_messages = 1024;   ///< messages that wait for a step, for each client; at this limit reading stops
  std::size_t output_bytes = 1 << 20;  ///< bytes that wait to be sent to a client; above it whole replies are dropped
                                       ///< dropped
  std::size_t input_bytes = 1 << 20;   ///< bytes that wait for a step, as input_messages
  /// Whether events are recorded, so that a replay repeats them. False: the receiver of the events records their
  /// effects in another way, and a replay has no events.
  bool is_recorded = true;
  /// Whether the algorithm disconnects a client that has ended its input, after it has answered everything. False: the
  /// client is disconnected as soon as a step sees that.
  bool has_late_replies = false;
};

/// One stream with its clients: a server, a client, a pseudo-terminal, a serial device, or a recording of one of these.
///
/// Input and output run in a thread that all streams of the plugin share. No function waits for a client, except
/// `begin` in lockstep. An algorithm that runs alone (Capability::runs_alone) makes all calls, so that external inputs
/// have an order. Messages that arrive between two steps take effect in the next step.
class Stream {
 public:
  /// `name`: name of the stream in the scenario, "rovers_3/laser"; also used in log lines. [setup]
  Stream(Connector& connector, std::string name, Address address, Framing framing, Limits limits = {});
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream();

  /// Opens the stream; does nothing when it is open, when a recording is replayed, or when the scenario is only
  /// checked. Throws muro::Error with the reason of the system: port in use, path not writable. [start]
  void open();

  /// Begins a step at `time` (ns). In lockstep it waits for the client, and the step has one message at most. Throws
  /// muro::Error when the client did not answer in time and the address says that this ends the run. [step]
  void begin(std::int64_t time);
  /// Begins a step at `time` without waiting, while the run is paused. [between steps]
  void poll(std::int64_t time);
  /// Returns the next event of this step, or null when there is no other. [step]
  const Event* next();
  /// Sends bytes to one client. Drops all of them when too much waits for this client. Never waits. Returns false when
  /// they were dropped; no state may depend on this result. [step]
  bool send(std::uint32_t client, std::string_view bytes);
  /// Sends the bytes, or drops and counts them when more than `most` would wait; the rest is for others. [step]
  bool send(std::uint32_t client, std::string_view bytes, std::size_t most);
  /// Number of bytes sent to the client that have not gone out yet. [step]
  std::size_t waiting(std::uint32_t client) const;
  /// Sends bytes to every client. [step]
  void send_to_all(std::string_view bytes);
  /// Stops reading from the client while `held` is true. Data that has been read before still arrives: at most twice
  /// the amount that a step takes. [step]
  void hold(std::uint32_t client, bool held);
  /// Reports that a message was answered or needs no answer; once for each message, for lockstep. [step]
  void answered();
  /// Reports that measurements are sent without a request for each one, for lockstep. [step]
  void set_subscribed(bool subscribed);
  /// Ends the connection when all sent bytes have gone out. [step]
  void disconnect(std::uint32_t client);
  /// Sets the bit rate of a serial device or of a timed stream; 0: the rate at the start. A serial device sends earlier
  /// bytes at the old rate. In a timed stream the bytes that have not passed yet continue at the new rate. [step]
  void set_baud(std::uint32_t baud);

  /// Puts the counts into the report, and warns of dropped or refused data. For Algorithm::finish(). [finish]
  void finish();

  bool is_replayed() const;
  const Address& address() const;  ///< address with the actual port, when open
  const std::string& name() const;
  Statistics statistics() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace muro::stream
