// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include "interpolate.hpp"

// Many samples at once where the processor can; the same bits everywhere, since nothing is contracted.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MURO_WIDE __attribute__((target_clones("default", "avx2")))
#else
#define MURO_WIDE
#endif

namespace muro::zbuffer {

namespace {

MURO_WIDE void sample_whole(const float* __restrict picture, std::int32_t stride, std::size_t count,
                            const std::int32_t* __restrict pixel, const float* __restrict across,
                            const float* __restrict down, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float f = across[i];
    const auto row = [&](std::int32_t first) {
      return between(picture[first - 1], picture[first], picture[first + 1], picture[first + 2], f);
    };
    const std::int32_t p = pixel[i];
    const float above = row(p - stride), first = row(p), second = row(p + stride), below = row(p + 2 * stride);
    out[i] = between(above, first, second, below, down[i]);
  }
}

MURO_WIDE void sample_line(const float* __restrict picture, std::int32_t step, std::size_t count,
                           const std::int32_t* __restrict pixel, const float* __restrict along, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t p = pixel[i];
    out[i] = between(picture[p - step], picture[p], picture[p + step], picture[p + 2 * step], along[i]);
  }
}

}  // namespace

void sample(Extent extent, const float* picture, std::int32_t stride, const Samples& s, float* inverse) {
  switch (extent) {
    case Extent::whole:
      return sample_whole(picture, stride, s.size(), s.pixel.data(), s.across.data(), s.down.data(), inverse);
    case Extent::level:
      return sample_line(picture, 1, s.size(), s.pixel.data(), s.across.data(), inverse);
    case Extent::upright:
      return sample_line(picture, stride, s.size(), s.pixel.data(), s.down.data(), inverse);
    case Extent::point:
      for (std::size_t i = 0; i < s.size(); ++i) inverse[i] = picture[s.pixel[i]];
  }
}

}  // namespace muro::zbuffer
