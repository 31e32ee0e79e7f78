// SPDX-License-Identifier: MIT
// Interpolation between the pixels of a depth image.
#pragma once

#include <cstdint>

namespace muro::zbuffer {

/// Eight numbers in a SIMD vector (vector extensions of GCC and clang).
using Float8 = float __attribute__((vector_size(32)));
using Mask8 = std::int32_t __attribute__((vector_size(32)));

#define MURO_ALWAYS_INLINE inline __attribute__((always_inline))

MURO_ALWAYS_INLINE float zero(const float&) { return 0; }
MURO_ALWAYS_INLINE Float8 zero(const Float8&) { return Float8{}; }
MURO_ALWAYS_INLINE float select(bool which, const float& a, const float& b) { return which ? a : b; }
MURO_ALWAYS_INLINE Float8 select(const Mask8& which, const Float8& a, const Float8& b) { return which ? a : b; }

/// Returns the value at `f` (0..1) between `b` and `c`. a, b, c, d are four pixels in a row that hold 1 / depth, or 0
/// if nothing was drawn. On a plane 1 / depth is linear in the position on the image, so linear interpolation is exact
/// there. If b and c differ by more than twice the slope of the surfaces on either side, in the same direction, there
/// is an edge between them. Then no value between both sides is invented: the surface of the nearer pixel is
/// extrapolated. S is float or Float8.
template <class S>
MURO_ALWAYS_INLINE S interpolate(const S& a, const S& b, const S& c, const S& d, const S& f) {
  const S none = zero(a), one = none + 1;
  const S before = b - a, step = c - b, after = d - c;
  const S before_size = select(before < none, -before, before), after_size = select(after < none, -after, after);
  const S step_size = select(step < none, -step, step);
  const S slope_before = select(before * step > none, before_size, none);
  const S slope_after = select(after * step > none, after_size, none);
  const S slope = select(slope_before > slope_after, slope_before, slope_after);
  const S max = select(b > c, b, c), min = select(b < c, b, c);  // min is 0 if one side is empty
  const S rounding = max * 4e-6F;
  const auto smooth = step_size <= slope * 2 + rounding;
  // A surface with a greater slope from pixel to pixel may be another edge.
  constexpr float max_slope = 0.02F;
  const S from_left = select(before_size < b * max_slope, f * before, none);
  const S from_right = select(after_size < c * max_slope, (one - f) * after, none);
  const S side = select(f < none + 0.5F, b + from_left, c - from_right);
  return select(smooth, select(min > none, b + f * step, side), side);
}

}  // namespace muro::zbuffer
