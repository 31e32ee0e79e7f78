// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "plugins/common/line_of_sight/spatial_hash.hpp"
#include "radio.hpp"

namespace muro::log_distance {

/// A frame that is or was on the air.
struct Transmission {
  double start, end;  ///< s
  std::uint32_t radio;
  std::int64_t number;  ///< number of the message
};

/// Senders that share a medium. Each listens before it sends, by the unslotted CSMA-CA of IEEE 802.15.4-2006, section
/// 7.5.1.4. The first frame of a queue waits for a random number of slots, 0 to 2^BE - 1; then its radio listens. When
/// the medium is free, the frame is on the air after the turnaround. Otherwise BE and the number of back-offs grow;
/// after too many back-offs the frame is lost.
class SharedMedium {
 public:
  /// Reserves memory, so that steps do not allocate. [setup]
  void reserve(std::size_t radios) {
    attempts_.reserve(radios);
    senders_.reserve(radios);
    transmissions_.reserve(16 * radios);
    starts_from_.reserve(16 * radios);
    on_air_.reserve(16 * radios);
  }

  /// Processes all attempts until `now` (s), ordered by time, then by number of the radio. `places`: m, positions of
  /// the radios; `sensing`: m, distance within which a sender can make the medium busy. Called by one thread.
  void advance(const Channel& channel, std::span<const Radio> radios, std::span<const Vec3> places, double sensing,
               double now, std::uint64_t seed);

  /// Lists the transmissions that overlap in time with complete frames. `disturbing`: m, radius of searches. Called by
  /// one thread.
  void list_transmissions(std::span<const Radio> radios, std::span<const Vec3> places, double disturbing);
  /// Calls visit(number of a transmission, squared distance of its sender in m^2) for the transmissions within `radius`
  /// (m) of `centre`.
  template <class Visit>
  void each_within(const Vec3& centre, double radius, Visit visit) const {
    on_air_.each_within(centre, radius, visit);
  }
  const Transmission& operator[](std::uint32_t i) const { return transmissions_[i]; }
  std::size_t transmission_capacity() const { return transmissions_.capacity(); }

 private:
  struct Attempt {
    double time;  ///< s
    std::uint32_t radio;
    /// Puts the earliest attempt at the top of a heap.
    bool operator<(const Attempt& b) const { return time != b.time ? time > b.time : radio > b.radio; }
  };
  void add(const Radio& r, std::uint32_t number, double now);

  std::vector<Attempt> attempts_;  ///< attempts of this step, a heap
  SpatialHash senders_;            ///< over the positions of all radios
  std::vector<Transmission> transmissions_;
  std::vector<Vec3> starts_from_;  ///< m: positions of their senders
  SpatialHash on_air_;             ///< over starts_from_
};

}  // namespace muro::log_distance
