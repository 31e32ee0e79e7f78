// SPDX-License-Identifier: MIT
// The parts of a host that a stream uses, for tests.
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "muro/connector.hpp"
#include "muro/ext/external_inputs.hpp"
#include "muro/ext/lockstep.hpp"
#include "muro/ext/report_entries.hpp"

namespace muro::stream {

/// Records the inputs of one channel, or replays them.
class FakeInputs final : public ExternalInputs, public InputChannel {
 public:
  struct Input {
    std::int64_t time;
    std::uint32_t kind, source;
    std::string bytes;
    bool operator==(const Input&) const = default;
  };
  std::vector<Input> inputs;
  bool replays = false, opens = true;
  std::string why_not_repeatable;

  InputChannel* channel(std::string_view) noexcept override { return std::exchange(is_taken_, true) ? nullptr : this; }
  bool may_open() const noexcept override { return opens; }
  bool set_sink(InputSink*) noexcept override { return false; }
  bool set_recording(std::span<const RecordedInput>) noexcept override { return false; }
  std::uint64_t unused(std::string_view&) const noexcept override { return inputs.size() - next_; }
  std::uint64_t initial_hash() const noexcept override { return 0; }
  std::uint64_t robots_hash() const noexcept override { return 0; }
  std::int64_t time() const noexcept override { return 0; }
  std::uint64_t epoch() const noexcept override { return 0; }
  void not_repeatable(std::string_view why) noexcept override { why_not_repeatable = why; }

  bool is_replayed() const noexcept override { return replays; }
  void record(std::int64_t time, const ExternalInput& input) noexcept override {
    inputs.push_back({time, input.kind, input.source, std::string(input.bytes)});
  }
  bool replay(std::int64_t time, ExternalInput& input) noexcept override {
    if (next_ == inputs.size() || inputs[next_].time != time) return false;
    const Input& next = inputs[next_++];
    input = {next.kind, next.source, next.bytes};
    return true;
  }

 private:
  bool is_taken_ = false;
  std::size_t next_ = 0;
};

/// A report that keeps the numbers of the algorithms.
class FakeReport final : public ReportEntries {
 public:
  std::vector<std::pair<std::string, std::uint64_t>> numbers;
  void set(const ReportEntry& entry) noexcept override {
    const auto text = [](std::string_view part) { return std::string(part) + "/"; };
    numbers.emplace_back(text(entry.section) + text(entry.name) + std::string(entry.key), std::uint64_t(entry.value));
  }
};

class FakeHost final : public Host {
 public:
  ExternalInputs* inputs = nullptr;
  Lockstep* lockstep = nullptr;
  ReportEntries* report = nullptr;

  void log(LogLevel level, std::string_view text) noexcept override {
    const std::lock_guard lock(mutex_);
    if (level >= LogLevel::warning) warnings_.emplace_back(text);
  }
  void* find_extension(const ExtensionId& id) noexcept override {
    if (id.name == ExternalInputs::id().name) return inputs;
    if (id.name == Lockstep::id().name) return lockstep;
    return id.name == ReportEntries::id().name ? report : nullptr;
  }
  std::vector<std::string> warnings() {
    const std::lock_guard lock(mutex_);
    return warnings_;
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> warnings_;
};

/// Connects an algorithm that serves robots of given names. The scene has nothing else.
class FakeConnector final : public Connector {
 public:
  explicit FakeConnector(const std::vector<std::string>& robots = {"rover_3"}) : names_(robots) {
    for (const std::string& name : names_) robots_.emplace_back().name = name;
    for (const RobotView& robot : robots_) items_.push_back({.robot = &robot});
  }
  mutable FakeHost fake_host;

  Rows<Item> items() const noexcept override { return items_; }
  const Parameters& parameters() const noexcept override { return parameters_; }
  const Parameters& parameters_of(std::uint32_t) const noexcept override { return parameters_; }
  Host& host() const noexcept override { return fake_host; }
  std::uint64_t random_key(std::uint32_t) const noexcept override { return 0; }
  double rate() const noexcept override { return 0; }
  std::string_view resolve_path(std::string_view path) const noexcept override { return path; }
  std::uint32_t object_count() const noexcept override { return 0; }
  std::string_view object_name(ObjectId) const noexcept override { return {}; }
  ObjectId find_object(std::string_view) const noexcept override { return no_object; }
  std::span<const RobotView* const> robots() const noexcept override { return {}; }
  RobotId robot_of(ObjectId) const noexcept override { return no_robot; }
  std::string_view text(TextId) const noexcept override { return {}; }
  Rows<FoundProperty> properties(ObjectId) const noexcept override { return {}; }
  bool is_used(ObjectId, const KeyInfo&, Usage) const noexcept override { return false; }
  void* state_block(ObjectId, std::string_view, std::uint32_t) noexcept override { return nullptr; }

 protected:
  void* bind(ObjectId, const KeyInfo&, Usage, Multiplicity, std::uint32_t, const void*) noexcept override {
    return nullptr;
  }
  ArrayHeader constant_raw(ObjectId, const KeyInfo&) const noexcept override { return {}; }
  void set_raw(ObjectId, const KeyInfo&, const void*) noexcept override {}

 private:
  std::vector<std::string> names_;
  std::deque<RobotView> robots_;
  std::vector<Item> items_;
  Parameters parameters_;
};

}  // namespace muro::stream
