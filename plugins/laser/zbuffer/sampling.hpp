// SPDX-License-Identifier: MIT
// From pictures of distances to the distances along rays.
#pragma once

#include <cstdint>
#include <vector>

namespace muro::zbuffer {

/// Where rays find their distances in a picture, one array a quantity.
struct Samples {
  std::vector<std::uint32_t> ray;   ///< place in the reading
  std::vector<std::int32_t> pixel;  ///< in the picture: the upper left of the four around the ray
  std::vector<float> across, down;  ///< from that pixel's middle, 0..1
  std::vector<double> per_depth;    ///< length of the ray by depth along the view's axis

  void add(std::uint32_t number, std::int32_t upper_left, float x, float y, double length) {
    ray.push_back(number);
    pixel.push_back(upper_left);
    across.push_back(x);
    down.push_back(y);
    per_depth.push_back(length);
  }
  std::size_t size() const { return ray.size(); }
};

/// What of a picture counts.
enum class Extent {
  whole,
  level,    ///< one row
  upright,  ///< one column
  point,    ///< one pixel
};

/// 1 / depth at each sample of a picture with `stride` pixels from row to row; `inverse` has room for all.
void sample(Extent extent, const float* picture, std::int32_t stride, const Samples& samples, float* inverse);

}  // namespace muro::zbuffer
