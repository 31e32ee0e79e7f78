// SPDX-License-Identifier: MIT
// From depth images to the distances along rays.
#pragma once

#include <cstdint>
#include <vector>

namespace muro::zbuffer {

/// Where rays find their distances in an image: a structure of arrays.
struct Samples {
  std::vector<std::uint32_t> ray;        ///< number of the ray in the scan
  std::vector<std::int32_t> pixel;       ///< in the image: the upper left of the four around the ray
  std::vector<float> across, down;       ///< from the centre of that pixel, 0..1
  std::vector<double> length_per_depth;  ///< of the ray by depth along the axis of the camera
  std::vector<std::int32_t> nearest;     ///< pixel in the image

  void add(std::uint32_t number, std::int32_t upper_left, float x, float y, double length, std::int32_t nearest_pixel) {
    ray.push_back(number);
    pixel.push_back(upper_left);
    across.push_back(x);
    down.push_back(y);
    length_per_depth.push_back(length);
    nearest.push_back(nearest_pixel);
  }
  /// To be called after the last sample: repeats it until the size is a multiple of the SIMD width.
  void pad();
  std::size_t size() const { return count_; }
  std::size_t padded_size() const { return ray.size(); }

 private:
  std::size_t count_ = 0;
};

enum class ImageShape { grid, row, column, pixel };

/// 1 / depth at each sample of an image with `stride` pixels from row to row; `inverse` has padded_size elements.
void sample(ImageShape shape, const float* image, std::int32_t stride, const Samples& samples, float* inverse);

/// The same for a grid of rays whose columns are columns of the image too: each row of pixels is first interpolated at
/// the columns of rays, once for all rays. `columns`: in the first of `rows` rows of pixels. `samples`: `pixel` and
/// `down` in the image so computed, which has columns.padded_size() pixels in a row. `scratch` holds that image.
void sample_grid(const float* image, std::int32_t stride, std::uint32_t rows, const Samples& columns,
                 const Samples& samples, std::vector<float>& scratch, float* inverse);

}  // namespace muro::zbuffer
