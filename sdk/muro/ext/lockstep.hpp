// SPDX-License-Identifier: MIT
// Simulated time that waits for programs outside of the simulation.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A stream of an external client for which time waits.
///
/// A client may have several streams. Time goes on only while an answer is due to the client: while one of its
/// messages, on any stream, is not answered yet. When all messages are answered it is the client's turn: time stops at
/// the next step of an algorithm that serves one of its streams, until the client has sent another message. Time never
/// waits for a stream alone that has a subscription (measurements that come without single requests).
class LockstepStream {
 public:
  enum class Outcome : std::uint8_t {
    go_on,
    timed_out,  ///< nothing has come within the time-out
    stopping,   ///< the run is to end
  };
  /// Notes that a client is there, or has left: time does not wait for a client that has left. [any thread]
  virtual void set_connected(bool connected) noexcept = 0;
  /// Notes that a whole message has arrived, which a step will take. [any thread]
  virtual void message_arrived() noexcept = 0;
  /// Notes that a message was answered, or needs no answer. [step]
  virtual void message_answered() noexcept = 0;
  virtual void set_subscribed(bool subscribed) noexcept = 0;  ///< [step]
  /// Waits until time may leave the instant `time`. [step]
  virtual Outcome wait(std::int64_t time) noexcept = 0;

 protected:
  ~LockstepStream() = default;
};

/// An extension of hosts, version 1.
class Lockstep {
 public:
  /// Adds a stream to `client`, the name of a program outside. `timeout`: s of the wall clock that a wait may take.
  /// Returns the stream, valid as long as the simulation. [setup]
  virtual LockstepStream& join(std::string_view client, std::string_view stream, double timeout) noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static Lockstep* of(Host& host) { return static_cast<Lockstep*>(host.find_extension(id())); }

 protected:
  ~Lockstep() = default;
};

inline ExtensionId Lockstep::id() noexcept {
  return {"muro.Lockstep", 1,
          abi::extension_layout<Lockstep>({}, &LockstepStream::set_connected, &LockstepStream::message_arrived,
                                          &LockstepStream::message_answered, &LockstepStream::set_subscribed,
                                          &LockstepStream::wait, &Lockstep::join)};
}

}  // namespace muro
