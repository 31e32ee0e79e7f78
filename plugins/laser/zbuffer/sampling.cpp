// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include <algorithm>

#include "interpolate.hpp"

// By the instructions that the processor has; the same bits with all, since nothing is contracted.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MURO_FOR_EACH_PROCESSOR __attribute__((target_clones("default", "avx2")))
#else
#define MURO_FOR_EACH_PROCESSOR
#endif

namespace muro::zbuffer {

namespace {

constexpr std::size_t wide = 8;

/// What a picture holds at eight pixels, each so far from those of `pixel`.
MURO_ALWAYS void gather(const float* picture, const std::int32_t* pixel, std::int32_t offset, Eight& out) {
  for (std::size_t k = 0; k < wide; ++k) out[k] = picture[pixel[k] + offset];
}

/// Between four pixels, each `step` from the next.
MURO_ALWAYS void across_four(const float* picture, const std::int32_t* pixel, std::int32_t first, std::int32_t step,
                             const Eight& f, Eight& out) {
  Eight a, b, c, d;
  gather(picture, pixel, first - step, a);
  gather(picture, pixel, first, b);
  gather(picture, pixel, first + step, c);
  gather(picture, pixel, first + 2 * step, d);
  out = between(a, b, c, d, f);
}

MURO_ALWAYS void load(const float* from, Eight& out) {
  for (std::size_t k = 0; k < wide; ++k) out[k] = from[k];
}

/// `count` is a multiple of eight.
MURO_FOR_EACH_PROCESSOR void sample_whole(const float* picture, std::int32_t stride, std::size_t count,
                                          const std::int32_t* pixel, const float* across, const float* down,
                                          float* out) {
  for (std::size_t i = 0; i < count; i += wide) {
    Eight f, g, above, first, second, below;
    load(across + i, f);
    load(down + i, g);
    across_four(picture, pixel + i, -stride, 1, f, above);
    across_four(picture, pixel + i, 0, 1, f, first);
    across_four(picture, pixel + i, stride, 1, f, second);
    across_four(picture, pixel + i, 2 * stride, 1, f, below);
    const Eight found = between(above, first, second, below, g);
    for (std::size_t k = 0; k < wide; ++k) out[i + k] = found[k];
  }
}

MURO_FOR_EACH_PROCESSOR void sample_line(const float* picture, std::int32_t step, std::size_t count,
                                         const std::int32_t* pixel, const float* along, float* out) {
  for (std::size_t i = 0; i < count; i += wide) {
    Eight f, found;
    load(along + i, f);
    across_four(picture, pixel + i, 0, step, f, found);
    for (std::size_t k = 0; k < wide; ++k) out[i + k] = found[k];
  }
}

}  // namespace

void Samples::fill() {
  count_ = ray.size();
  while (ray.size() % wide != 0)
    add(ray.back(), pixel.back(), across.back(), down.back(), per_depth.back(), nearest.back());
}

void sample(Extent extent, const float* picture, std::int32_t stride, const Samples& s, float* inverse) {
  switch (extent) {
    case Extent::whole:
      return sample_whole(picture, stride, s.room(), s.pixel.data(), s.across.data(), s.down.data(), inverse);
    case Extent::level:
      return sample_line(picture, 1, s.room(), s.pixel.data(), s.across.data(), inverse);
    case Extent::upright:
      return sample_line(picture, stride, s.room(), s.pixel.data(), s.down.data(), inverse);
    case Extent::point:
      for (std::size_t i = 0; i < s.size(); ++i) inverse[i] = picture[s.pixel[i]];
  }
}

void sample_grid(const float* picture, std::int32_t stride, std::uint32_t rows, const Samples& columns,
                 const Samples& s, std::vector<float>& between_columns, float* inverse) {
  const std::size_t wide_row = columns.room();
  between_columns.resize(std::max(between_columns.size(), rows * wide_row));
  for (std::uint32_t row = 0; row < rows; ++row)
    sample_line(picture + std::size_t(row) * std::size_t(stride), 1, wide_row, columns.pixel.data(),
                columns.across.data(), &between_columns[row * wide_row]);
  sample_line(between_columns.data(), std::int32_t(wide_row), s.room(), s.pixel.data(), s.down.data(), inverse);
}

}  // namespace muro::zbuffer
