// SPDX-License-Identifier: MIT
#include "core/external/input_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/algorithm_setup.hpp"
#include "core/error.hpp"
#include "core/external/run_requests.hpp"
#include "core/running_call.hpp"
#include "core/schedule/scheduler.hpp"
#include "core/world.hpp"

namespace muro {

bool RecordedChannel::is_replayed() const noexcept { return log_.has_recording(); }

void RecordedChannel::record(std::int64_t time, const ExternalInput& input) noexcept {
  log_.record({name_, log_.epoch(), time, input});
}

void RecordedChannel::add(const RecordedInput& input) {
  entries_.push_back(
      {input.epoch, input.time, input.input.kind, input.input.source, bytes_.size(), input.input.bytes.size()});
  bytes_ += input.input.bytes;
}

/// Skips the inputs that no algorithm took at their time.
void RecordedChannel::skip_missed(std::int64_t time) {
  const auto now = std::tuple(log_.epoch(), time);
  for (; next_ < entries_.size() && std::tuple(entries_[next_].epoch, entries_[next_].time) < now; ++next_) ++unused_;
}

bool RecordedChannel::replay(std::int64_t time, ExternalInput& input) noexcept {
  if (time < 0) return log_.shows_all() && take_next(input);
  skip_missed(time);
  if (next_ == entries_.size()) return false;
  const Entry& e = entries_[next_];
  if (e.epoch != log_.epoch() || e.time != time || !take_next(input)) return false;
  log_.record_again({name_, e.epoch, e.time, input});
  return true;
}

bool RecordedChannel::take_next(ExternalInput& input) {
  if (next_ == entries_.size()) return false;
  const Entry& e = entries_[next_++];
  input = {e.kind, e.source, std::string_view(bytes_).substr(e.begin, e.size)};
  return true;
}

std::uint32_t RecordedChannel::highest_kind() const {
  std::uint32_t highest = 0;
  for (const Entry& e : entries_) highest = std::max(highest, e.kind);
  return highest;
}

std::int64_t RecordedChannel::next_time() const {
  const bool is_there = next_ < entries_.size() && entries_[next_].epoch == log_.epoch();
  return is_there ? entries_[next_].time : std::numeric_limits<std::int64_t>::max();
}

RecordedChannel* InputLog::find(std::string_view name) {
  if (name == own_.name()) return &own_;
  const auto found =
      std::find_if(channels_.begin(), channels_.end(), [&](const Place& p) { return p.channel.name() == name; });
  return found == channels_.end() ? nullptr : &found->channel;
}

std::uint64_t InputLog::robots_hash() const noexcept { return world_.hash_of_robots(); }
std::int64_t InputLog::time() const noexcept { return scheduler_.now(); }

InputChannel* InputLog::channel(std::string_view name) noexcept {
  if (name == own_.name()) return nullptr;
  if (!find(name)) channels_.push_back({RecordedChannel(*this, std::string(name)), false});
  const auto place =
      std::find_if(channels_.begin(), channels_.end(), [&](const Place& p) { return p.channel.name() == name; });
  if (place->is_taken) return nullptr;
  place->is_taken = true;
  return &place->channel;
}

bool InputLog::set_sink(InputSink* sink) noexcept {
  const std::lock_guard lock(mutex_);
  if (sink && sink_) return false;
  sink_ = sink;
  return true;
}

bool InputLog::set_recording(std::span<const RecordedInput> inputs) noexcept {
  if (has_recording_) return false;
  has_recording_ = true;
  if (const Callee* const replay = running_call().callee.load())
    replay_ = fmt::format("{}{} ({}): ", prefix_of(replay->place), replay->name, replay->use);
  for (const RecordedInput& input : inputs) {
    if (!find(input.channel)) channels_.push_back({RecordedChannel(*this, std::string(input.channel)), false});
    find(input.channel)->add(input);
  }
  return true;
}

void InputLog::check_recording() const {
  std::string channels;
  for (const Place& p : channels_)
    if (p.is_taken) channels += (channels.empty() ? "`" : ", `") + p.channel.name() + "`";
  for (const Place& p : channels_)
    if (!p.is_taken)
      throw SetupError(
          fmt::format("{}the recording has {} of channel `{}`, which no algorithm of the scenario takes; {}", replay_,
                      p.channel.size() == 1 ? "an input" : fmt::format("{} inputs", p.channel.size()), p.channel.name(),
                      channels.empty() ? "there is none that takes inputs" : "there are the channels " + channels));
  constexpr auto last = std::uint32_t(RunRequests::Kind::stop);
  if (own_.highest_kind() > last)
    throw SetupError(fmt::format("{}the recording cannot be replayed: kind {} of channel `{}` is none of 0 to {}",
                                 replay_, own_.highest_kind(), own_.name(), last));
}

std::uint64_t InputLog::unused(std::string_view& channel) const noexcept {
  std::uint64_t all = 0;
  const auto add = [&](const RecordedChannel& c) {
    if (all == 0 && c.unused() > 0) channel = c.name();
    all += c.unused();
  };
  add(own_);
  for (const Place& p : channels_) add(p.channel);
  return all;
}

void InputLog::record(const RecordedInput& input) noexcept {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (sink_) sink_->take(input);
}

void InputLog::record_again(const RecordedInput& input) noexcept {
  const std::lock_guard lock(mutex_);
  if (sink_) sink_->take(input);
}

void InputLog::not_repeatable(std::string_view why) noexcept {
  constexpr std::size_t most = 20;
  const std::lock_guard lock(mutex_);
  if (reasons_.size() < most && std::find(reasons_.begin(), reasons_.end(), why) == reasons_.end())
    reasons_.emplace_back(why);
}

}  // namespace muro
