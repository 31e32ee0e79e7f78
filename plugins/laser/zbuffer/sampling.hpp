// SPDX-License-Identifier: MIT
// From pictures of distances to the distances along rays.
#pragma once

#include <cstdint>
#include <vector>

namespace muro::zbuffer {

/// Where rays find their distances in a picture, one array a quantity.
struct Samples {
  std::vector<std::uint32_t> ray;     ///< place in the reading
  std::vector<std::int32_t> pixel;    ///< in the picture: the upper left of the four around the ray
  std::vector<float> across, down;    ///< from that pixel's middle, 0..1
  std::vector<double> per_depth;      ///< length of the ray by depth along the view's axis
  std::vector<std::int32_t> nearest;  ///< pixel in the picture

  void add(std::uint32_t number, std::int32_t upper_left, float x, float y, double length, std::int32_t middle) {
    ray.push_back(number);
    pixel.push_back(upper_left);
    across.push_back(x);
    down.push_back(y);
    per_depth.push_back(length);
    nearest.push_back(middle);
  }
  /// To be called when all are there: makes room for several at once by repeating the last.
  void fill();
  std::size_t size() const { return count_; }
  std::size_t room() const { return ray.size(); }

 private:
  std::size_t count_ = 0;
};

/// What of a picture counts.
enum class Extent {
  whole,
  level,    ///< one row
  upright,  ///< one column
  point,    ///< one pixel
};

/// 1 / depth at each sample of a picture with `stride` pixels from row to row; `inverse` has their room.
void sample(Extent extent, const float* picture, std::int32_t stride, const Samples& samples, float* inverse);

/// The same for rays in rows and columns whose columns are upright in the picture: each row of pixels is first brought
/// to the columns of rays, once for all rays. `columns`: in the first of `rows` rows of pixels. `samples`: `pixel` and
/// `down` in the picture so made, which has columns.room() pixels in a row. `between_columns` is memory.
void sample_grid(const float* picture, std::int32_t stride, std::uint32_t rows, const Samples& columns,
                 const Samples& samples, std::vector<float>& between_columns, float* inverse);

}  // namespace muro::zbuffer
