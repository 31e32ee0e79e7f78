// SPDX-License-Identifier: MIT
// Between the pixels of a picture of distances.
#pragma once

namespace muro::zbuffer {

/// The value at `f` (0..1) between `b` and `c`, of four pixels a, b, c, d in a row that hold 1 / depth, 0 where nothing
/// is. On a plane 1 / depth is linear in the place on the picture, so the straight line between neighbours is exact
/// there. Where they step apart by more than twice what the surfaces on either side slope the same way, there is an
/// edge between them; nothing is then made up between the two sides: the nearer pixel's surface goes on to the place
/// that is asked for. Written without branches, for many at once.
inline float between(float a, float b, float c, float d, float f) {
  const auto size = [](float x) { return x < 0 ? -x : x; };
  const auto greater = [](float x, float y) { return x > y ? x : y; };
  const float before = b - a, step = c - b, after = d - c;
  const float slope = greater(before * step > 0 ? size(before) : 0, after * step > 0 ? size(after) : 0);
  const float rounding = 4e-6F * greater(b, c);
  const float line = b + f * step;
  // A surface that slopes by more than this from pixel to pixel may be another edge.
  constexpr float steepest = 0.02F;
  const float going = a > 0 ? (size(before) < steepest * b ? f * before : 0) : 0;
  const float coming = d > 0 ? (size(after) < steepest * c ? (1 - f) * after : 0) : 0;
  const float side = f < 0.5F ? b + going : c - coming;
  const float edge = size(step) - (2 * slope + rounding);  // above 0: there is one
  const float least = b < c ? b : c;                       // 0: one side is nothing
  return edge <= 0 ? (least > 0 ? line : side) : side;
}

}  // namespace muro::zbuffer
