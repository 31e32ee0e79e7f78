// SPDX-License-Identifier: MIT
// Finds the boxes in range of a scanner, once a scan, sixteen boxes at a time.
//
// Floats only decide what can be skipped, and their errors never skip too much. A box relative to the scanner is
// clipped to the cube of the scanner's range, so that all its points are nearer than 1.8 `extent`, its greatest
// coordinate. It is then enlarged by 4e-6 extent, several times the rounding error of floats at that distance. If a ray
// enters the true box after t, the distances to the planes of the enlarged box, computed with an error of 2.4e-7 t,
// enclose t. If a ray is on the inner side of a frustum plane, which is rotated in floats with an error of 1e-6 in its
// normal, a corner of the enlarged box is on that side as well.
#pragma once

#include "lanes.hpp"
#include "scene_view.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

inline constexpr float slack = 4e-6f;
inline constexpr float min_slack = 1e-8f;
inline constexpr std::uint32_t robot_bit = 1u << 31;

/// The scanner in the coordinates of a table.
struct TableOrigin {
  float position[3];
  float range;
  float rounding;  ///< m, rounding error of differences of coordinates, at most `range`

  MURO_INLINE TableOrigin(const BoxTable& table, const ScanQuery& query) {
    float extent = table.extent;
    for (int k = 0; k < 3; ++k) {
      position[k] = float(query.position[k] - table.centre[k]);
      extent = lane::max(extent, lane::abs(position[k]));
    }
    range = float(query.max_range) * (1 + slack);
    rounding = lane::min(min_slack + 3e-7f * extent, range);
  }
};

/// The sixteen boxes of a block relative to the scanner, clipped and enlarged.
struct BlockFromScanner {
  F low[3], high[3];
  F extent;
  F near2;  ///< square of the distance, m^2

  MURO_INLINE BlockFromScanner(const BoxBlock& boxes, const TableOrigin& origin) {
    const F range(origin.range);
    extent = F(0);
    for (int k = 0; k < 3; ++k) {
      low[k] = lane::max(load<F>(boxes.low[k]) - F(origin.position[k]), -range);
      high[k] = lane::min(load<F>(boxes.high[k]) - F(origin.position[k]), range);
      extent = lane::max(extent, lane::max(-low[k], high[k]));
    }
    const F margin = extent * F(slack) + F(origin.rounding);
    near2 = F(0);
    for (int k = 0; k < 3; ++k) {
      low[k] -= margin;
      high[k] += margin;
      const F away = lane::max(lane::max(low[k], -high[k]), F(0));
      near2 += away * away;
    }
  }
};

/// Returns the overlap (m) of each box with the region of the rays, which is between two cones about the z axis of the
/// device; negative for a box that is completely above or below the region.
MURO_INLINE F elevation_overlap(const BlockFromScanner& b, const ScanQuery& s) {
  const float ux(float(s.axes[2])), uy(float(s.axes[5])), uz(float(s.axes[8]));
  const F half(0.5f);
  const F cx = (b.low[0] + b.high[0]) * half, cy = (b.low[1] + b.high[1]) * half, cz = (b.low[2] + b.high[2]) * half;
  const F hx = (b.high[0] - b.low[0]) * half, hy = (b.high[1] - b.low[1]) * half, hz = (b.high[2] - b.low[2]) * half;
  const F up = cx * F(ux) + cy * F(uy) + cz * F(uz);
  const F half_height = hx * F(lane::abs(ux)) + hy * F(lane::abs(uy)) + hz * F(lane::abs(uz));
  const F fx = cx - F(ux) * up, fy = cy - F(uy) * up, fz = cz - F(uz) * up;
  const F flat = lane::sqrt(fx * fx + fy * fy + fz * fz);
  const F radius = lane::sqrt(hx * hx + hy * hy + hz * hz) + b.extent * F(2 * slack) + F(min_slack);
  const F near = lane::max(flat - radius, F(0)), far = flat + radius;
  const auto finite = [](double slope) { return float(lane::max(lane::min(slope, 1e30), -1e30)); };
  const float low = finite(s.min_slope), high = finite(s.max_slope);
  const F bottom = F(low) * (low > 0 ? near : far), top = F(high) * (high > 0 ? far : near);
  return lane::min(up + half_height - bottom, top - (up - half_height)) + b.extent * F(slack);
}

/// Finds the boxes of a table that are in range. Calls visit(BoxBlock, BlockFromScanner, bits) for each block that has
/// such boxes.
template <class Visit>
MURO_INLINE void find_in_range(const BoxTable& table, const ScanQuery& query, Visit visit) {
  const TableOrigin origin(table, query);
  const F range2(float(query.max_range * query.max_range));
  for (std::uint32_t g = 0; g < table.group_count; ++g) {
    unsigned blocks = signs(BlockFromScanner(table.groups[g], origin).near2 - range2);
    for (; blocks != 0; blocks &= blocks - 1) {
      const BoxBlock& boxes = table.blocks[16 * g + unsigned(__builtin_ctz(blocks))];
      const BlockFromScanner relative(boxes, origin);
      unsigned found = signs(relative.near2 - range2);
      if (found != 0) found &= ~signs(elevation_overlap(relative, query));
      if (found != 0) visit(boxes, relative, found);
    }
  }
}

/// Candidates sorted into bins by distance, each a thirty-second of the range: near candidates hide far ones.
class DistanceBins {
 public:
  explicit DistanceBins(double max_range) : per_metre_(float(count / max_range)) {}

  /// Finds the bin of each box, as a float.
  MURO_INLINE void bins_of(const BlockFromScanner& relative, float (&bins)[16]) const {
    store(bins, lane::min(lane::sqrt(relative.near2) * F(per_metre_), F(count - 1)));
  }
  MURO_INLINE void count_one(std::uint32_t bin) { ++begin_[bin + 1]; }

  /// Copies the candidates in the order of their bins; returns the number of blocks.
  std::uint32_t sort(std::uint32_t candidates, const Scratch& scratch) {
    for (int bin = 0; bin < count; ++bin) begin_[bin + 1] += begin_[bin];
    for (std::uint32_t k = 0; k < candidates; ++k) {
      const CandidateRef from = scratch.order[k];
      const std::uint32_t to = begin_[from.distance_bin]++;
      const RelativeBoxes& boxes = scratch.boxes[from.index / 16];
      Candidates& block = scratch.in_range[to / 16];
      for (int axis = 0; axis < 3; ++axis) {
        block.low[axis][to % 16] = boxes.low[axis][from.index % 16];
        block.high[axis][to % 16] = boxes.high[axis][from.index % 16];
      }
      block.item[to % 16] = boxes.item[from.index % 16];
    }
    const std::uint32_t blocks = (candidates + 15) / 16;
    std::uint32_t bin = 0;  // bin of the first candidate in a block; begin_[bin] is now the end of the bin
    for (std::uint32_t b = 0; b < blocks; ++b) {
      Candidates& block = scratch.in_range[b];
      block.count = candidates - 16 * b < 16 ? candidates - 16 * b : 16;
      while (begin_[bin] <= 16 * b) ++bin;
      block.near = float(bin) / per_metre_ * (1 - slack);
    }
    return blocks;
  }

 private:
  static constexpr int count = 32;
  float per_metre_;
  std::uint32_t begin_[count + 1] = {};
};

/// Finds all candidates, sorted by distance; returns the number of their blocks.
inline std::uint32_t gather_candidates(const SceneView& view, const ScanQuery& query, const Scratch& scratch) {
  std::uint32_t count = 0, robots = 0;
  DistanceBins bins(query.max_range);
  RelativeBoxes* last = scratch.boxes;
  const auto add = [&](const BlockFromScanner& relative, unsigned found, auto item_of) {
    for (int k = 0; k < 3; ++k) store(last->low[k], relative.low[k]), store(last->high[k], relative.high[k]);
    alignas(64) float bin_of[16];
    bins.bins_of(relative, bin_of);
    const std::uint32_t block = std::uint32_t(last - scratch.boxes) * 16;
    for (; found != 0; found &= found - 1) {
      const std::uint32_t i = std::uint32_t(__builtin_ctz(found));
      const std::uint32_t bin = std::uint32_t(bin_of[i]);
      last->item[i] = item_of(i);
      scratch.order[count++] = {block + i, bin};
      bins.count_one(bin);
    }
    ++last;
  };
  find_in_range(view.scenery, query, [&](const BoxBlock& boxes, const BlockFromScanner& relative, unsigned found) {
    add(relative, found, [&](std::uint32_t i) { return boxes.item[i]; });
  });
  find_in_range(view.moving, query, [&](const BoxBlock& boxes, const BlockFromScanner& relative, unsigned found) {
    for (unsigned f = found; f != 0; f &= f - 1)
      if (boxes.item[__builtin_ctz(f)] == query.ignored_robot) found &= ~(f & -f);
    add(relative, found, [&](std::uint32_t i) {
      scratch.robots[robots] = {boxes.item[i], -1};
      return robots++ | robot_bit;
    });
  });
  return bins.sort(count, scratch);
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
