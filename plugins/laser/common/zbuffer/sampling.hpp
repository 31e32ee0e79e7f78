// SPDX-License-Identifier: MIT
// Computes distances along rays from depth images.
#pragma once

#include <cstdint>
#include <vector>

namespace muro::zbuffer {

/// Positions of rays in an image: a structure of arrays.
struct Samples {
  std::vector<std::uint32_t> ray;        ///< number of the ray in the scan
  std::vector<std::int32_t> pixel;       ///< number of the upper left of the four pixels around the ray
  std::vector<float> across, down;       ///< from the centre of that pixel, 0..1
  std::vector<double> length_per_depth;  ///< length of the ray by depth along the axis of the camera
  std::vector<std::int32_t> nearest;     ///< number of the nearest pixel

  void add(std::uint32_t number, std::int32_t upper_left, float x, float y, double length, std::int32_t nearest_pixel) {
    ray.push_back(number);
    pixel.push_back(upper_left);
    across.push_back(x);
    down.push_back(y);
    length_per_depth.push_back(length);
    nearest.push_back(nearest_pixel);
  }
  /// Repeats the last sample until the size is a multiple of the SIMD width. Call it after the last sample.
  void pad();
  std::size_t size() const { return count_; }
  std::size_t padded_size() const { return ray.size(); }

 private:
  std::size_t count_ = 0;
};

enum class ImageShape { grid, row, column, pixel };

/// Computes 1 / depth at each sample of an image with `stride` pixels from row to row. `inverse`: padded_size elements.
void sample(ImageShape shape, const float* image, std::int32_t stride, const Samples& samples, float* inverse);

/// Samples a grid of rays with columns that are columns of the image too: first interpolates each row of pixels at the
/// columns of rays, once for all rays. `columns`: in the first of `rows` rows of pixels. `samples`: `pixel` and `down`
/// in the resulting image, which has columns.padded_size() pixels in a row. `scratch` holds that image.
void sample_grid(const float* image, std::int32_t stride, std::uint32_t rows, const Samples& columns,
                 const Samples& samples, std::vector<float>& scratch, float* inverse);

}  // namespace muro::zbuffer
