// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include <algorithm>

#include "interpolate.hpp"

// Compiled for several instruction sets. All give the same bits, as no operations are contracted.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MURO_FOR_EACH_ISA __attribute__((target_clones("default", "avx2")))
#else
#define MURO_FOR_EACH_ISA
#endif

namespace muro::zbuffer {

namespace {

constexpr std::size_t width = 8;

/// Reads the values of eight pixels, each `offset` after one of `pixel`.
MURO_ALWAYS_INLINE void gather(const float* image, const std::int32_t* pixel, std::int32_t offset, Float8& out) {
  for (std::size_t k = 0; k < width; ++k) out[k] = image[pixel[k] + offset];
}

/// Interpolates between four pixels, each `step` after the previous one.
MURO_ALWAYS_INLINE void interpolate_line(const float* image, const std::int32_t* pixel, std::int32_t first,
                                         std::int32_t step, const Float8& f, Float8& out) {
  Float8 a, b, c, d;
  gather(image, pixel, first - step, a);
  gather(image, pixel, first, b);
  gather(image, pixel, first + step, c);
  gather(image, pixel, first + 2 * step, d);
  out = interpolate(a, b, c, d, f);
}

MURO_ALWAYS_INLINE void load(const float* from, Float8& out) {
  for (std::size_t k = 0; k < width; ++k) out[k] = from[k];
}

/// `count` is a multiple of eight.
MURO_FOR_EACH_ISA void sample_four_by_four(const float* image, std::int32_t stride, std::size_t count,
                                           const std::int32_t* pixel, const float* across, const float* down,
                                           float* out) {
  for (std::size_t i = 0; i < count; i += width) {
    Float8 f, g, above, first, second, below;
    load(across + i, f);
    load(down + i, g);
    interpolate_line(image, pixel + i, -stride, 1, f, above);
    interpolate_line(image, pixel + i, 0, 1, f, first);
    interpolate_line(image, pixel + i, stride, 1, f, second);
    interpolate_line(image, pixel + i, 2 * stride, 1, f, below);
    const Float8 found = interpolate(above, first, second, below, g);
    for (std::size_t k = 0; k < width; ++k) out[i + k] = found[k];
  }
}

MURO_FOR_EACH_ISA void sample_line(const float* image, std::int32_t step, std::size_t count, const std::int32_t* pixel,
                                   const float* along, float* out) {
  for (std::size_t i = 0; i < count; i += width) {
    Float8 f, found;
    load(along + i, f);
    interpolate_line(image, pixel + i, 0, step, f, found);
    for (std::size_t k = 0; k < width; ++k) out[i + k] = found[k];
  }
}

}  // namespace

void Samples::pad() {
  count_ = ray.size();
  while (ray.size() % width != 0)
    add(ray.back(), pixel.back(), across.back(), down.back(), length_per_depth.back(), nearest.back());
}

void sample(ImageShape shape, const float* image, std::int32_t stride, const Samples& s, float* inverse) {
  switch (shape) {
    case ImageShape::grid:
      return sample_four_by_four(image, stride, s.padded_size(), s.pixel.data(), s.across.data(), s.down.data(),
                                 inverse);
    case ImageShape::row:
      return sample_line(image, 1, s.padded_size(), s.pixel.data(), s.across.data(), inverse);
    case ImageShape::column:
      return sample_line(image, stride, s.padded_size(), s.pixel.data(), s.down.data(), inverse);
    case ImageShape::pixel:
      for (std::size_t i = 0; i < s.size(); ++i) inverse[i] = image[s.pixel[i]];
  }
}

void sample_grid(const float* image, std::int32_t stride, std::uint32_t rows, const Samples& columns, const Samples& s,
                 std::vector<float>& scratch, float* inverse) {
  const std::size_t padded_columns = columns.padded_size();
  scratch.resize(std::max(scratch.size(), rows * padded_columns));
  for (std::uint32_t row = 0; row < rows; ++row)
    sample_line(image + std::size_t(row) * std::size_t(stride), 1, padded_columns, columns.pixel.data(),
                columns.across.data(), &scratch[row * padded_columns]);
  sample_line(scratch.data(), std::int32_t(padded_columns), s.padded_size(), s.pixel.data(), s.down.data(), inverse);
}

}  // namespace muro::zbuffer
