// SPDX-License-Identifier: MIT
// Between the pixels of a picture of distances.
#pragma once

#include <cstdint>

namespace muro::zbuffer {

/// Eight numbers that are worked on at once, by what instructions the processor has (vectors of GCC and clang).
using Eight = float __attribute__((vector_size(32)));
using EightFlags = std::int32_t __attribute__((vector_size(32)));

#define MURO_ALWAYS inline __attribute__((always_inline))

MURO_ALWAYS float nought(const float&) { return 0; }
MURO_ALWAYS Eight nought(const Eight&) { return Eight{}; }
MURO_ALWAYS float select(bool which, const float& a, const float& b) { return which ? a : b; }
MURO_ALWAYS Eight select(const EightFlags& which, const Eight& a, const Eight& b) { return which ? a : b; }

/// The value at `f` (0..1) between `b` and `c`, of four pixels a, b, c, d in a row that hold 1 / depth, 0 where nothing
/// is. On a plane 1 / depth is linear in the place on the picture, so the straight line between neighbours is exact
/// there. Where they step apart by more than twice what the surfaces on either side slope the same way, there is an
/// edge between them; nothing is then made up between the two sides: the nearer pixel's surface goes on to the place
/// that is asked for. S is float or Eight.
template <class S>
MURO_ALWAYS S between(const S& a, const S& b, const S& c, const S& d, const S& f) {
  const S none = nought(a), one = none + 1;
  const S before = b - a, step = c - b, after = d - c;
  const S before_size = select(before < none, -before, before), after_size = select(after < none, -after, after);
  const S step_size = select(step < none, -step, step);
  const S slope_before = select(before * step > none, before_size, none);
  const S slope_after = select(after * step > none, after_size, none);
  const S slope = select(slope_before > slope_after, slope_before, slope_after);
  const S most = select(b > c, b, c), least = select(b < c, b, c);  // least is 0 where one side is nothing
  const S rounding = most * 4e-6F;
  const auto smooth = step_size <= slope * 2 + rounding;
  // A surface that slopes by more than this from pixel to pixel may be another edge.
  constexpr float steepest = 0.02F;
  const S going = select(before_size < b * steepest, f * before, none);
  const S coming = select(after_size < c * steepest, (one - f) * after, none);
  const S side = select(f < none + 0.5F, b + going, c - coming);
  return select(smooth, select(least > none, b + f * step, side), side);
}

}  // namespace muro::zbuffer
