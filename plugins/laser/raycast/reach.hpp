// SPDX-License-Identifier: MIT
// What is in reach of a scanner: once a scan, sixteen boxes at a time.
//
// Floats decide only what need not be looked at, and err on one side. A box seen from the scanner is clipped to the
// cube of its reach, so that no point of it is farther than 1.8 `extent`, its greatest coordinate, and then enlarged by
// 4e-6 extent: several times what floats can be wrong by at that distance. Where a ray meets the true box after t, the
// distances to the planes of the enlarged one, computed with an error of 2.4e-7 t, leave t between them; and a plane
// that has the ray on its inner side, turned in floats with an error of 1e-6 in its normal, has a corner of the
// enlarged box there.
#pragma once

#include "lanes.hpp"
#include "sight.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

inline constexpr float slack = 4e-6f;
inline constexpr float least_slack = 1e-8f;
inline constexpr std::uint32_t visitor_bit = 1u << 31;

/// The scanner in the coordinates of a table.
struct Origin {
  float at[3];
  float reach;
  float rounding;  ///< m, of the differences of coordinates, at most `reach`

  MURO_INLINE Origin(const BoxTable& table, const Scanner& scanner) {
    float most = table.extent;
    for (int k = 0; k < 3; ++k) {
      at[k] = float(scanner.position[k] - table.centre[k]);
      most = lane::max(most, lane::abs(at[k]));
    }
    reach = float(scanner.max_range) * (1 + slack);
    rounding = lane::min(least_slack + 3e-7f * most, reach);
  }
};

/// Sixteen boxes, seen from the scanner.
struct Seen {
  F low[3], high[3];
  F extent;
  F near2;  ///< square of the distance

  MURO_INLINE Seen(const Boxes& boxes, const Origin& origin) {
    const F reach(origin.reach);
    extent = F(0);
    for (int k = 0; k < 3; ++k) {
      low[k] = lane::max(load<F>(boxes.low[k]) - F(origin.at[k]), -reach);
      high[k] = lane::min(load<F>(boxes.high[k]) - F(origin.at[k]), reach);
      extent = lane::max(extent, lane::max(-low[k], high[k]));
    }
    const F wider = extent * F(slack) + F(origin.rounding);
    near2 = F(0);
    for (int k = 0; k < 3; ++k) {
      low[k] -= wider;
      high[k] += wider;
      const F away = lane::max(lane::max(low[k], -high[k]), F(0));
      near2 += away * away;
    }
  }
};

/// How far (m) a box reaches into the rays, which lie between two cones about the z axis of the device; negative for
/// one that is all above or all below them.
MURO_INLINE F into_elevations(const Seen& b, const Scanner& s) {
  const float ux(float(s.axes[2])), uy(float(s.axes[5])), uz(float(s.axes[8]));
  const F half(0.5f);
  const F cx = (b.low[0] + b.high[0]) * half, cy = (b.low[1] + b.high[1]) * half, cz = (b.low[2] + b.high[2]) * half;
  const F hx = (b.high[0] - b.low[0]) * half, hy = (b.high[1] - b.low[1]) * half, hz = (b.high[2] - b.low[2]) * half;
  const F up = cx * F(ux) + cy * F(uy) + cz * F(uz);
  const F tall = hx * F(lane::abs(ux)) + hy * F(lane::abs(uy)) + hz * F(lane::abs(uz));
  const F fx = cx - F(ux) * up, fy = cy - F(uy) * up, fz = cz - F(uz) * up;
  const F flat = lane::sqrt(fx * fx + fy * fy + fz * fz);
  const F radius = lane::sqrt(hx * hx + hy * hy + hz * hz) + b.extent * F(2 * slack) + F(least_slack);
  const F near = lane::max(flat - radius, F(0)), far = flat + radius;
  const auto finite = [](double slope) { return float(lane::max(lane::min(slope, 1e30), -1e30)); };
  const float low = finite(s.min_slope), steep = finite(s.max_slope);
  const F bottom = F(low) * (low > 0 ? near : far), top = F(steep) * (steep > 0 ? far : near);
  return lane::min(up + tall - bottom, top - (up - tall)) + b.extent * F(slack);
}

/// Finds the boxes of a table that are in reach; calls take(Boxes, Seen, bits) for each sixteen.
template <class Take>
MURO_INLINE void search(const BoxTable& table, const Scanner& scanner, Take take) {
  const Origin origin(table, scanner);
  const F reach2(float(scanner.max_range * scanner.max_range));
  for (std::uint32_t g = 0; g < table.group_count; ++g) {
    unsigned blocks = signs(Seen(table.groups[g], origin).near2 - reach2);
    for (; blocks != 0; blocks &= blocks - 1) {
      const Boxes& boxes = table.blocks[16 * g + unsigned(__builtin_ctz(blocks))];
      const Seen seen(boxes, origin);
      unsigned found = signs(seen.near2 - reach2);
      if (found != 0) found &= ~signs(into_elevations(seen, scanner));
      if (found != 0) take(boxes, seen, found);
    }
  }
}

/// Finds all candidates and sorts them by distance, into shells of a thirty-second of the range: near ones hide far
/// ones. Returns the number of blocks.
inline std::uint32_t gather(const Sight& sight, const Scanner& scanner, const Memory& memory) {
  constexpr int shells = 32;
  std::uint32_t count = 0, visitors = 0;
  std::uint32_t begin[shells + 1] = {};
  const float per_metre = float(shells / scanner.max_range);
  Found* last = memory.found;
  const auto add = [&](const Seen& seen, unsigned found, auto what_of) {
    for (int k = 0; k < 3; ++k) store(last->low[k], seen.low[k]), store(last->high[k], seen.high[k]);
    alignas(64) float near[16];
    store(near, lane::min(lane::sqrt(seen.near2) * F(per_metre), F(shells - 1)));
    const std::uint32_t block = std::uint32_t(last - memory.found) * 16;
    for (; found != 0; found &= found - 1) {
      const std::uint32_t i = std::uint32_t(__builtin_ctz(found));
      const std::uint32_t shell = std::uint32_t(near[i]);
      last->what[i] = what_of(i);
      memory.order[count++] = {block + i, shell};
      ++begin[shell + 1];
    }
    ++last;
  };
  search(sight.scenery, scanner, [&](const Boxes& boxes, const Seen& seen, unsigned found) {
    add(seen, found, [&](std::uint32_t i) { return boxes.item[i]; });
  });
  search(sight.moving, scanner, [&](const Boxes& boxes, const Seen& seen, unsigned found) {
    for (unsigned f = found; f != 0; f &= f - 1)
      if (std::int32_t(boxes.item[__builtin_ctz(f)]) == scanner.ignored_robot) found &= ~(f & -f);
    add(seen, found, [&](std::uint32_t i) {
      memory.visitors[visitors] = {boxes.item[i], -1};
      return visitors++ | visitor_bit;
    });
  });
  for (int s = 0; s < shells; ++s) begin[s + 1] += begin[s];
  for (std::uint32_t k = 0; k < count; ++k) {
    const Place from = memory.order[k];
    const std::uint32_t to = begin[from.shell]++;
    const Found& f = memory.found[from.at / 16];
    Candidates& block = memory.in_reach[to / 16];
    for (int axis = 0; axis < 3; ++axis) {
      block.low[axis][to % 16] = f.low[axis][from.at % 16];
      block.high[axis][to % 16] = f.high[axis][from.at % 16];
    }
    block.what[to % 16] = f.what[from.at % 16];
  }
  const std::uint32_t blocks = (count + 15) / 16;
  std::uint32_t shell = 0;  // of the first in a block; begin[shell] is now where it ends
  for (std::uint32_t b = 0; b < blocks; ++b) {
    Candidates& block = memory.in_reach[b];
    block.count = count - 16 * b < 16 ? count - 16 * b : 16;
    while (begin[shell] <= 16 * b) ++shell;
    block.near = float(shell) / per_metre * (1 - slack);
  }
  return blocks;
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
