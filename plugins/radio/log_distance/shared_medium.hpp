// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "plugins/common/spatial_hash/spatial_hash.hpp"
#include "radio.hpp"

namespace muro::log_distance {

/// A frame that is, was or will be on the air.
struct Transmission {
  double start, end;  ///< s
  std::uint32_t radio;
  std::int64_t number;  ///< of the message
};

/// Senders that share a medium: each listens before it sends, by the unslotted CSMA-CA of IEEE 802.15.4-2006, section
/// 7.5.1.4. A frame at the head of a queue waits for a random number of slots, 0 to 2^BE - 1, and then listens; where
/// the medium is free, it is on the air after the turnaround, else BE and the number of back-offs grow, and after too
/// many the frame is lost.
class SharedMedium {
 public:
  /// So that steps do not allocate. [setup]
  void reserve(std::size_t radios) {
    attempts_.reserve(radios);
    transmissions_.reserve(16 * radios);
  }

  /// Everything that happens until `now` (s), in the order of time, then of radios. `places`: of the radios, m, over
  /// which `hash` is built; `sensing`: m, so far any of them makes the medium busy. By one thread.
  void advance(const Channel& channel, std::span<const Radio> radios, std::span<const Vec3> places,
               const SpatialHash& hash, double sensing, double now, std::uint64_t seed);

  /// Lists all transmissions, in the order of their starts. By one thread.
  void list_transmissions(std::span<const Radio> radios);
  /// Calls visit(transmission, its number) for all that overlap in time with what begins and ends at `start` and `end`
  /// (s).
  template <class Visit>
  void each_overlapping(double start, double end, Visit visit) const {
    const auto begins_before = [](const Transmission& t, double time) { return t.start < time; };
    auto t = std::lower_bound(transmissions_.begin(), transmissions_.end(), start - longest_, begins_before);
    for (; t != transmissions_.end() && t->start < end; ++t)
      if (t->end > start) visit(*t, std::size_t(t - transmissions_.begin()));
  }

  std::size_t transmission_count() const { return transmissions_.size(); }

 private:
  struct Attempt {
    double time;  ///< s
    std::uint32_t radio;
    /// For a heap whose top is the first.
    bool operator<(const Attempt& b) const { return time != b.time ? time > b.time : radio > b.radio; }
  };
  void add(const Radio& r, std::uint32_t number, double now);

  std::vector<Attempt> attempts_;  ///< a heap, of this step
  std::vector<Transmission> transmissions_;
  double longest_ = 0;  ///< s, of the transmissions
};

}  // namespace muro::log_distance
