// SPDX-License-Identifier: MIT
#include "send_queue.hpp"

#include <algorithm>
#include <string>

#include "muro/algorithm.hpp"

namespace muro::log_distance {

namespace {

constexpr std::uint32_t longest_message = 65535;                // bytes
constexpr std::int64_t largest_number = std::int64_t(1) << 53;  // greatest whole number that a header holds exactly

/// Returns the number of frames that have not begun at `now` (s).
std::size_t waiting_frames(const Radio& r, double now) {
  std::size_t count = 0;
  for (const Frame& f : *r.frames) count += f.stage == Stage::waiting || (f.stage == Stage::on_air && f.start > now);
  return count;
}

Frame frame_of(const Radio& r, double now, std::int64_t number) {
  Frame f;
  f.handed_over = now;
  f.number = number;
  f.receiver = *r.send_receiver;
  f.size = *r.send_size;
  std::copy_n(r.send_bytes->bytes, std::min(f.size, radio::max_bytes), f.payload.bytes);
  return f;
}

}  // namespace

void end_reception(const Radio& r) {
  for (Frame& f : *r.frames)
    if (f.stage == Stage::complete) f.stage = Stage::past;
}

void forget_frames(const Radio& r, double time) {
  const std::span<Frame> frames = *r.frames;
  const auto is_needed = [&](const Frame& f) { return f.stage != Stage::past || f.end > time; };
  if (std::all_of(frames.begin(), frames.end(), is_needed)) return;
  r.frames.clear();
  for (const Frame& f : frames)
    if (is_needed(f)) r.frames.push_back(f);
}

void take_message(const Radio& r, double now) {
  const std::int64_t command = *r.send_number;
  Access& access = *r.access;
  if (command == access.last_command) return;
  if (access.last_command > 0 && command > access.last_command)
    r.counters->lost_overrun += std::uint64_t(command - access.last_command - 1);
  access.last_command = command;
  if (*r.send_size > longest_message)
    throw Error("radio.send.size is " + std::to_string(*r.send_size) + "; a message has at most " +
                std::to_string(longest_message) + " bytes");
  access.last_number = std::max(access.last_number + 1, command <= largest_number ? command : 0);
  const bool is_idle = first_waiting(r) == nullptr && now >= access.on_air_until;
  if (!is_idle && waiting_frames(r, now) >= r.parameters.queue) {
    ++r.counters->lost_queue;
    return;
  }
  r.frames.push_back(frame_of(r, now, access.last_number));
}

void transmit(const Radio& r) {
  Access& access = *r.access;
  for (Frame& f : *r.frames) {
    if (f.stage != Stage::waiting) continue;
    f.stage = Stage::on_air;
    f.start = std::max(f.handed_over, access.on_air_until);
    f.end = f.start + r.parameters.airtime(f.size);
    access.on_air_from = f.start, access.on_air_until = f.end;
  }
}

bool complete_frames(const Radio& r, double now) {
  bool any = false;
  for (Frame& f : *r.frames) {
    if (f.stage != Stage::on_air || f.end > now) continue;
    f.stage = Stage::complete;
    ++r.counters->sent;
    any = true;
  }
  return any;
}

Frame* first_waiting(const Radio& r) {
  for (Frame& f : *r.frames)
    if (f.stage == Stage::waiting) return &f;
  return nullptr;
}

}  // namespace muro::log_distance
