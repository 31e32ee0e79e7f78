// SPDX-License-Identifier: MIT
#include "shared_medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "send_queue.hpp"

namespace muro::log_distance {

namespace {

/// Number of the draw of back-offs; draws of messages have other numbers.
constexpr std::uint32_t backoff_draw = 5;

/// Returns a random back-off in s: a random number of slots by the present exponent.
double backoff(const Radio& r, std::uint64_t seed) {
  const Random random(seed, fnv1a("backoff", r.key), r.access->draws++);
  const double slots = std::ldexp(1.0, int(r.access->exponent));
  return std::floor(slots * random.uniform(backoff_draw)) * r.parameters.backoff_slot;
}

/// The frame at the head begins to wait for the medium at `time` (s).
void contend(const Radio& r, double time, std::uint64_t seed) {
  r.access->backoffs = 0;
  r.access->exponent = r.parameters.min_exponent;
  r.access->attempt = time + backoff(r, seed);
}

/// Removes the first frame that waits.
void drop_head(const Radio& r) {
  const Frame* head = first_waiting(r);
  const std::span<Frame> frames = *r.frames;
  r.frames.clear();
  for (const Frame& f : frames)
    if (&f != head) r.frames.push_back(f);
}

/// Returns whether a radio hears another one at `time`. `senders`: hash over the positions of all radios.
bool is_busy(const Channel& channel, std::span<const Radio> radios, std::span<const Vec3> places,
             const SpatialHash& senders, double sensing, std::uint32_t number, double time, std::uint64_t seed) {
  const Radio& r = radios[number];
  bool busy = false;
  senders.each_within(places[number], sensing, [&](std::uint32_t i, double) {
    const Radio& other = radios[i];
    if (busy || i == number || time < other.access->on_air_from || time >= other.access->on_air_until) return;
    const std::int64_t heard = other.access->on_air_number;
    const auto power = channel.received_power(
        seed, other, places[i], r, places[number], heard, r.parameters.carrier_sense, [&](std::uint32_t most) {
          return channel.sight->obstacles(places[number], places[i], r.robot, other.robot, most);
        });
    busy = power.has_value();
  });
  return busy;
}

void put_on_air(const Radio& r, double start) {
  Frame& f = *first_waiting(r);
  f.stage = Stage::on_air;
  f.start = start;
  f.end = start + r.parameters.airtime(f.size);
  r.access->on_air_from = f.start, r.access->on_air_until = f.end;
  r.access->on_air_number = f.number;
}

}  // namespace

void SharedMedium::add(const Radio& r, std::uint32_t number, double now) {
  if (!first_waiting(r) || r.access->attempt > now) return;
  attempts_.push_back({r.access->attempt, number});
  std::push_heap(attempts_.begin(), attempts_.end());
}

void SharedMedium::advance(const Channel& channel, std::span<const Radio> radios, std::span<const Vec3> places,
                           double sensing, double now, std::uint64_t seed) {
  attempts_.clear();
  for (std::uint32_t i = 0; i < radios.size(); ++i) {
    const Radio& r = radios[i];
    const Frame* head = first_waiting(r);
    if (!head) continue;
    // a frame that has just come to an idle radio has not contended yet
    if (r.access->contending_for != head->number) {
      contend(r, std::max(head->handed_over, r.access->on_air_until), seed);
      r.access->contending_for = head->number;
    }
    add(r, i, now);
  }
  if (!attempts_.empty()) senders_.build(places, sensing);
  while (!attempts_.empty()) {
    std::pop_heap(attempts_.begin(), attempts_.end());
    const Attempt attempt = attempts_.back();
    attempts_.pop_back();
    const Radio& r = radios[attempt.radio];
    Access& access = *r.access;
    double next_frame_from = attempt.time;
    bool head_is_done = true;
    if (!is_busy(channel, radios, places, senders_, sensing, attempt.radio, attempt.time, seed)) {
      put_on_air(r, attempt.time + r.parameters.turnaround);
      next_frame_from = access.on_air_until;
    } else if (++access.backoffs > r.parameters.max_backoffs) {
      drop_head(r);
      ++r.counters->lost_access;
    } else {
      head_is_done = false;
      access.exponent = std::min(access.exponent + 1, r.parameters.max_exponent);
      access.attempt = attempt.time + backoff(r, seed);
    }
    const Frame* head = first_waiting(r);
    if (head_is_done && head) {
      contend(r, next_frame_from, seed);
      access.contending_for = head->number;
    }
    add(r, attempt.radio, now);
  }
}

void SharedMedium::list_transmissions(std::span<const Radio> radios, std::span<const Vec3> places, double disturbing) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Radio& r : radios)
    for (const Frame& f : *r.frames)
      if (f.stage == Stage::complete) first = std::min(first, f.start), last = std::max(last, f.end);
  transmissions_.clear(), starts_from_.clear();
  for (std::uint32_t i = 0; i < radios.size(); ++i)
    for (const Frame& f : *radios[i].frames) {
      if (f.stage == Stage::waiting || f.start >= last || f.end <= first) continue;
      transmissions_.push_back({f.start, f.end, i, f.number});
      starts_from_.push_back(places[i]);
    }
  on_air_.build(starts_from_, 0.5 * disturbing);
}

}  // namespace muro::log_distance
