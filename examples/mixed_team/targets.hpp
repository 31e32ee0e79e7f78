// SPDX-License-Identifier: MIT
// The targets that a member of the team knows. A member that finds one adds it. Lists of several robots are merged by
// place: entries nearer to each other than `same` are one target.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "../common/place.hpp"

namespace mixed_team {

using examples::Point;

struct Target {
  Point at;                    ///< m: mean of the sightings
  std::int64_t sightings = 0;  ///< number of sightings
  std::int64_t confirmed = 0;  ///< 1: somebody has been there
};

class Targets {
 public:
  static constexpr std::size_t most = 16;
  static constexpr std::size_t none = most;
  static constexpr double same = 0.6;  ///< m

  std::size_t size() const { return std::size_t(count_); }
  const Target& operator[](std::size_t i) const { return targets_[i]; }
  Target& operator[](std::size_t i) { return targets_[i]; }

  std::size_t at(const Point& p) const {
    std::size_t best = none;
    double nearest = same;
    for (std::size_t i = 0; i < size(); ++i)
      if (const double d = distance(targets_[i].at, p); d < nearest) nearest = d, best = i;
    return best;
  }
  /// Adds a sighting. When the list is full, it replaces the target that was seen least.
  void see(const Point& p) {
    std::size_t i = place(p);
    if (i == none) {
      i = std::size_t(std::min_element(targets_.begin(), targets_.end(), seen_less) - targets_.begin());
      targets_[i] = {p, 0, 0};
    }
    Target& t = targets_[i];
    ++t.sightings;
    t.at = t.at + (1.0 / double(t.sightings)) * (p - t.at);
  }
  /// Adds the knowledge of a mate: the place with more sightings is taken, and a confirmed target stays confirmed.
  /// Returns its number here; `none` when the list is full.
  std::size_t learn(const Target& told) {
    const std::size_t i = place(told.at);
    if (i == none) return none;
    Target& t = targets_[i];
    if (told.sightings > t.sightings) t.at = told.at, t.sightings = told.sightings;
    if (told.confirmed != 0) t.confirmed = 1;
    return i;
  }

 private:
  static bool seen_less(const Target& a, const Target& b) {
    return a.confirmed != b.confirmed ? a.confirmed < b.confirmed : a.sightings < b.sightings;
  }
  std::size_t place(const Point& p) {
    const std::size_t known = at(p);
    if (known != none || size() == most) return known;
    targets_[size()].at = p;
    return std::size_t(count_++);
  }

  std::array<Target, most> targets_{};
  std::int64_t count_ = 0;
};

}  // namespace mixed_team
