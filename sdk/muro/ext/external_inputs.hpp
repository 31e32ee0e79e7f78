// SPDX-License-Identifier: MIT
// Inputs from outside of the simulation, each with the instant at which it takes effect: recorded, and replayed.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// An input from outside. Only its channel knows its meaning.
struct ExternalInput {
  std::uint32_t kind = 0;
  std::uint32_t source = 0;  ///< one of several on one channel, such as the clients of a server
  std::string_view bytes;    ///< valid until the channel's next call
};

/// A recorded input. Inputs are in order of `epoch`, then of `time`; on one channel also within an instant.
struct RecordedInput {
  std::string_view channel;
  std::uint64_t epoch = 0;  ///< number of resets and restored snapshots before
  std::int64_t time = 0;    ///< ns of simulated time
  ExternalInput input;
};

/// Inputs of one stream, or of one program beside the simulation.
class InputChannel {
 public:
  /// Whether a recording replaces the outside: then nothing is opened, started or waited for. From start() on.
  virtual bool is_replayed() const noexcept = 0;
  /// Records that `input` takes effect in the step at `time`. Copies. [step]
  virtual void record(std::int64_t time, const ExternalInput& input) noexcept = 0;
  /// In a replay: takes the next input that was recorded for `time`. False: there is no other. [step]
  /// With a `time` below 0, from start() on: takes the next input of all, when the scenario is only inspected.
  virtual bool replay(std::int64_t time, ExternalInput& input) noexcept = 0;

 protected:
  ~InputChannel() = default;
};

/// Takes every input when it takes effect. [any thread, one call at a time]
class InputSink {
 public:
  virtual void take(const RecordedInput& input) noexcept = 0;

 protected:
  ~InputSink() = default;
};

/// An extension of hosts, version 1. With it a run can be repeated to the bit without those who took part in it from
/// outside.
class ExternalInputs {
 public:
  /// Returns the channel of this name, which is the same in each run of a scenario: "rovers_3/laser". A name has one
  /// user: null when it is taken. [setup]
  virtual InputChannel* channel(std::string_view name) noexcept = 0;
  /// Whether the outside may be opened: not when a scenario is only inspected. From start() on.
  virtual bool may_open() const noexcept = 0;
  /// Sets the recorder of inputs. False: there is one already. [setup]
  virtual bool set_sink(InputSink* sink) noexcept = 0;
  /// Sets the recording that replaces the outside in this run. Copies. False: there is one already. [setup]
  virtual bool set_recording(std::span<const RecordedInput> inputs) noexcept = 0;
  /// Returns the number of inputs of the recording that nobody has taken, and the channel of the first one. [finish]
  virtual std::uint64_t unused(std::string_view& channel) const noexcept = 0;
  /// Returns a hash of the seed and of the state of all robots before the first step: it says whether a recording
  /// belongs to this scenario. [step]
  virtual std::uint64_t initial_hash() const noexcept = 0;
  /// Returns a hash of the state of all robots now, without other objects such as a free camera. [between steps]
  virtual std::uint64_t robots_hash() const noexcept = 0;
  virtual std::int64_t time() const noexcept = 0;    ///< ns, time of the present state [between steps]
  virtual std::uint64_t epoch() const noexcept = 0;  ///< epoch of the present state [between steps]
  /// Notes that the run cannot be repeated from its scenario alone: an external client did not answer in time, for
  /// example. Reports say why. [any thread]
  virtual void not_repeatable(std::string_view why) noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static ExternalInputs* of(Host& host) { return static_cast<ExternalInputs*>(host.find_extension(id())); }

 protected:
  ~ExternalInputs() = default;
};

inline ExtensionId ExternalInputs::id() noexcept {
  static constexpr abi::Place structs[] = {
      MURO_SIZE(ExternalInput),         MURO_PLACE(ExternalInput, kind), MURO_PLACE(ExternalInput, source),
      MURO_PLACE(ExternalInput, bytes), MURO_SIZE(RecordedInput),        MURO_PLACE(RecordedInput, channel),
      MURO_PLACE(RecordedInput, epoch), MURO_PLACE(RecordedInput, time), MURO_PLACE(RecordedInput, input)};
  return {"muro.ExternalInputs", 1,
          abi::extension_layout<ExternalInputs>(
              structs, &InputChannel::is_replayed, &InputChannel::record, &InputChannel::replay, &InputSink::take,
              &ExternalInputs::channel, &ExternalInputs::may_open, &ExternalInputs::set_sink,
              &ExternalInputs::set_recording, &ExternalInputs::unused, &ExternalInputs::initial_hash,
              &ExternalInputs::robots_hash, &ExternalInputs::time, &ExternalInputs::epoch,
              &ExternalInputs::not_repeatable)};
}

}  // namespace muro
