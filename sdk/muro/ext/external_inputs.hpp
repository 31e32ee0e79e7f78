// SPDX-License-Identifier: MIT
// What comes from outside of the simulation, each with the instant at which it takes effect: recorded, and replayed.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// Something that came from outside. What it means, its channel alone knows.
struct ExternalInput {
  std::uint32_t kind = 0;
  std::uint32_t source = 0;  ///< of several on one channel, such as the clients of a server
  std::string_view bytes;    ///< good until the channel's next call
};

/// A recorded input. They are in order of `epoch`, then of `time`; on one channel also within an instant.
struct RecordedInput {
  std::string_view channel;
  std::uint64_t epoch = 0;  ///< how often the simulation was reset or restored before
  std::int64_t time = 0;    ///< ns of simulated time
  ExternalInput input;
};

/// Where the inputs of one stream, or of one program beside the simulation, come in.
class InputChannel {
 public:
  /// Whether a recording stands in for the outside: then nothing is opened, started or waited for. From start() on.
  virtual bool is_replayed() const noexcept = 0;
  /// `input` takes effect in the step at `time`. Copies. [step]
  virtual void record(std::int64_t time, const ExternalInput& input) noexcept = 0;
  /// In a replay: takes the next input that was recorded for `time`. False: there is no other. [step]
  /// With a `time` below 0, from start() on: the next of all, where the scenario is only looked at; else none.
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
  /// The channel of this name, which is the same in each run of a scenario: "rovers_3/laser". One name, one user:
  /// null when it is taken. [setup]
  virtual InputChannel* channel(std::string_view name) noexcept = 0;
  /// Whether the outside may be opened: not where a scenario is only looked at. From start() on.
  virtual bool may_open() const noexcept = 0;
  /// Who records. One at most: false when there is one already. [setup]
  virtual bool set_sink(InputSink* sink) noexcept = 0;
  /// What stands in for the outside in this run. Copies. False when there is a recording already. [setup]
  virtual bool set_recording(std::span<const RecordedInput> inputs) noexcept = 0;
  /// Inputs of the recording that nobody has taken, and the channel of the first of them; 0 when all were. [finish]
  virtual std::uint64_t unused(std::string_view& channel) const noexcept = 0;
  /// Of the seed and of the state of all robots before the first step: tells whether a recording belongs to this
  /// scenario. [step]
  virtual std::uint64_t initial_hash() const noexcept = 0;
  /// Of the state of all robots now: what is beside them, such as a camera that looks on, has no say in it. [between
  /// steps]
  virtual std::uint64_t robots_hash() const noexcept = 0;
  virtual std::int64_t time() const noexcept = 0;    ///< ns, of the state now [between steps]
  virtual std::uint64_t epoch() const noexcept = 0;  ///< of the state now [between steps]
  /// The run cannot be repeated from its scenario alone: an external client did not answer in time, for example.
  /// Reports say why. [any thread]
  virtual void not_repeatable(std::string_view why) noexcept = 0;

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
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
