// SPDX-License-Identifier: MIT
// Search for near points: square cells in x and y, found by hashing.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "muro/geometry.hpp"

namespace muro {

/// A spatial hash (Teschner et al.: Optimized spatial hashing for collision detection of deformable objects, VMV 2003)
/// over columns of square cross-section: x and y choose the cell, z does not. It is built anew in O(n) and keeps its
/// memory. Points of a cell are in the order of their numbers.
class SpatialHash {
 public:
  /// Reserves memory, so that building over `points` points does not allocate.
  void reserve(std::size_t points) {
    entries_.reserve(points);
    cells_.reserve(points);
    starts_.reserve(bucket_count(points) + 1);
  }

  /// Builds the hash over points (m), numbered from 0. Omits points that are not finite. `cell` (m, > 0): size of a
  /// cell, best the radius of the searches.
  void build(std::span<const Vec3> points, double cell) {
    per_cell_ = 1 / cell;
    const std::size_t buckets = bucket_count(points.size());
    shift_ = 64 - std::countr_zero(buckets);
    starts_.assign(buckets + 1, 0);
    cells_.clear();
    for (const Vec3& p : points) {
      const Cell c = p.allFinite() ? cell_at(p.x(), p.y()) : nowhere;
      cells_.push_back(c);
      if (c != nowhere) ++starts_[bucket_of(c) + 1];
    }
    for (std::size_t b = 0; b < buckets; ++b) starts_[b + 1] += starts_[b];
    entries_.resize(starts_[buckets]);
    for (std::size_t i = points.size(); i-- > 0;)
      if (cells_[i] != nowhere)
        entries_[--starts_[bucket_of(cells_[i]) + 1]] = {points[i], cells_[i], std::uint32_t(i)};
    // now starts_[b + 1] is where bucket b begins
  }

  /// Calls visit(number of the point, its squared distance in m^2) for each point within `radius` (m) of `centre`, in
  /// an order that depends only on the points.
  template <class Visit>
  void each_within(const Vec3& centre, double radius, Visit visit) const {
    if (entries_.empty() || !centre.allFinite()) return;
    const Cell low = cell_at(centre.x() - radius, centre.y() - radius);
    const Cell high = cell_at(centre.x() + radius, centre.y() + radius);
    const auto look_at = [&](const Entry& e) {
      const double squared = (e.point - centre).squaredNorm();
      if (squared <= radius * radius) visit(e.index, squared);
    };
    const double cells = (double(high.x) - low.x + 1) * (double(high.y) - low.y + 1);
    if (cells > double(entries_.size())) {
      for (const Entry& e : entries_) look_at(e);
      return;
    }
    for (std::int32_t y = low.y; y <= high.y; ++y)
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const std::size_t bucket = bucket_of({x, y});
        const std::size_t end = bucket + 2 < starts_.size() ? starts_[bucket + 2] : entries_.size();
        for (std::size_t i = starts_[bucket + 1]; i < end; ++i)
          if (entries_[i].cell == Cell{x, y}) look_at(entries_[i]);
      }
  }

 private:
  struct Cell {
    std::int32_t x, y;
    bool operator==(const Cell&) const = default;
  };
  struct Entry {
    Vec3 point;
    Cell cell;
    std::uint32_t index;
  };
  static constexpr Cell nowhere{INT32_MIN, INT32_MIN};

  static std::size_t bucket_count(std::size_t points) { return std::bit_ceil(std::max<std::size_t>(2 * points, 16)); }
  Cell cell_at(double x, double y) const {
    const auto number = [&](double at) { return std::int32_t(std::clamp(std::floor(at * per_cell_), -1e9, 1e9)); };
    return {number(x), number(y)};
  }
  std::size_t bucket_of(Cell c) const {
    const std::uint64_t mixed = (std::uint64_t(std::uint32_t(c.x)) << 32 | std::uint32_t(c.y)) * 0x9E3779B97F4A7C15ull;
    return std::size_t((mixed ^ (mixed << 32)) >> shift_);
  }

  double per_cell_ = 1;
  int shift_ = 60;
  std::vector<Entry> entries_;         ///< bucket by bucket
  std::vector<Cell> cells_;            ///< by number of the point
  std::vector<std::uint32_t> starts_;  ///< [b + 1]: begin of bucket b in entries_
};

}  // namespace muro
