// SPDX-License-Identifier: MIT
// From the light that comes in to the numbers of a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lens.hpp"
#include "muro/toolkit/random.hpp"

namespace muro::camera {

struct FilmSettings {
  double exposure = 0;    ///< stops: light times 2^exposure
  double vignetting = 0;  ///< 0..1: how much of the law of cos^4 dims the picture off its axis
  double blur = 0;        ///< px, standard deviation of the spot that a point becomes
  double noise = 0;       ///< standard deviation of what is added to each value, in terms of the greatest
  double shot_noise = 0;  ///< that of white; it falls with the root of the light

  bool does_nothing() const { return exposure == 0 && vignetting == 0 && blur == 0 && noise == 0 && shot_noise == 0; }
};

/// Pictures in linear light.
class Film {
 public:
  Film(const render::Camera& camera, const FilmSettings& settings);

  /// Takes a picture as it is (sRGB, as large as this one), or through a lens from the larger one that its map says.
  void expose(std::span<const std::uint8_t> rgb);
  void expose(std::span<const std::uint8_t> rgb, const LensMap& lens);
  /// Dims, blurs and adds noise; writes sRGB.
  void develop(const Random& random, std::span<std::uint8_t> rgb);

 private:
  void smear();

  FilmSettings settings_;
  std::uint32_t width_, height_;
  std::vector<float> light_, memory_;  ///< red, green, blue of each pixel
  std::vector<float> gain_;            ///< of each pixel
  std::vector<float> spot_;            ///< from its middle outwards
};

/// From a value of sRGB (0..255) to linear light (0..1), and back (IEC 61966-2-1).
float light_of(std::uint8_t value);
double value_of(double light);

}  // namespace muro::camera
