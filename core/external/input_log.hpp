// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "muro/ext/external_inputs.hpp"

namespace muro {

class InputLog;
class Scheduler;
class World;

/// The inputs of one channel name. In a replay it holds the inputs of the recording.
class RecordedChannel final : public InputChannel {
 public:
  RecordedChannel(InputLog& log, std::string name) : log_(log), name_(std::move(name)) {}
  const std::string& name() const { return name_; }

  bool is_replayed() const noexcept override;
  void record(std::int64_t time, const ExternalInput& input) noexcept override;
  bool replay(std::int64_t time, ExternalInput& input) noexcept override;

  void add(const RecordedInput& input);
  /// Time (ns) of the next recorded input of this epoch; the greatest number when there is none.
  std::int64_t next_time() const;
  std::size_t size() const { return entries_.size(); }
  std::uint32_t highest_kind() const;
  std::size_t unused() const { return unused_ + (entries_.size() - next_); }

 private:
  struct Entry {
    std::uint64_t epoch;
    std::int64_t time;
    std::uint32_t kind, source;
    std::size_t begin, size;  ///< position in bytes_
  };
  void skip_missed(std::int64_t time);
  bool take_next(ExternalInput& input);

  InputLog& log_;
  std::string name_;
  std::vector<Entry> entries_;
  std::string bytes_;
  std::size_t next_ = 0;
  std::size_t unused_ = 0;
};

/// All inputs from outside of a simulation: they are passed to a recorder, or taken from a recording.
class InputLog final : public ExternalInputs {
 public:
  InputLog(const World& world, const Scheduler& scheduler) : world_(world), scheduler_(scheduler) {}

  InputChannel* channel(std::string_view name) noexcept override;
  bool may_open() const noexcept override { return may_open_; }
  bool set_sink(InputSink* sink) noexcept override;
  bool set_recording(std::span<const RecordedInput> inputs) noexcept override;
  std::uint64_t unused(std::string_view& channel) const noexcept override;
  std::uint64_t initial_hash() const noexcept override { return initial_hash_; }
  std::uint64_t robots_hash() const noexcept override;
  std::int64_t time() const noexcept override;
  std::uint64_t epoch() const noexcept override { return epoch_; }
  void not_repeatable(std::string_view why) noexcept override;

  void set_initial_hash(std::uint64_t hash) { initial_hash_ = hash; }
  void keep_closed() { may_open_ = false; }
  /// Gives all recorded inputs through replay(-1), so that they can be inspected. For a simulation that does not run.
  void show_all() { shows_all_ = true; }
  bool shows_all() const { return shows_all_; }
  /// Throws SetupError when the recording holds inputs that this scenario does not take. Call when all channels exist.
  void check_recording() const;
  /// Called when the simulation was reset or restored: time jumps.
  void begin_epoch() { ++epoch_; }
  bool has_recording() const { return has_recording_; }
  /// The channel of the simulation itself.
  RecordedChannel& own_channel() { return own_; }
  void record(const RecordedInput& input) noexcept;
  /// Passes an input to the recorder that is not live: one from a recording, or the end of the run.
  void record_again(const RecordedInput& input) noexcept;

  std::uint64_t count() const { return count_; }  ///< number of live inputs so far
  const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  RecordedChannel* find(std::string_view name);

  const World& world_;
  const Scheduler& scheduler_;
  std::mutex mutex_;  ///< guards `sink_` and `reasons_`
  RecordedChannel own_{*this, "simulation"};
  struct Place {
    RecordedChannel channel;
    bool is_taken = false;
  };
  std::deque<Place> channels_;
  InputSink* sink_ = nullptr;
  bool has_recording_ = false;
  bool may_open_ = true, shows_all_ = false;
  std::string replay_;  ///< name of the algorithm that has the recording; begins messages about it
  std::uint64_t epoch_ = 0;
  std::uint64_t initial_hash_ = 0;
  std::uint64_t count_ = 0;
  std::vector<std::string> reasons_;
};

}  // namespace muro
