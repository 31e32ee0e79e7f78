// SPDX-License-Identifier: MIT
// Computes the values of an image from the light that reaches the sensor.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lens.hpp"
#include "muro/base/random.hpp"

namespace muro::camera {

struct ImageSettings {
  double exposure = 0;    ///< stops: light is multiplied by 2^exposure
  double vignetting = 0;  ///< 0..1: strength of the cos^4 law, which darkens the image off its axis
  double blur = 0;        ///< px, standard deviation of the Gaussian
  double noise = 0;       ///< standard deviation of the noise added to each value; 1: the greatest value
  double shot_noise = 0;  ///< standard deviation for white; proportional to the square root of the light

  bool is_identity() const { return exposure == 0 && vignetting == 0 && blur == 0 && noise == 0 && shot_noise == 0; }
};

/// Processes images in linear light.
class ImagePipeline {
 public:
  ImagePipeline(const render::Camera& camera, const ImageSettings& settings);

  /// Reads an image (sRGB) of the same size, or a larger one that is seen through a lens.
  void load(std::span<const std::uint8_t> rgb);
  void load(std::span<const std::uint8_t> rgb, const LensMap& lens);
  /// Applies exposure, vignetting, blur and noise; writes sRGB.
  void process(const Random& random, std::span<std::uint8_t> rgb);

 private:
  void blur();

  ImageSettings settings_;
  std::uint32_t width_, height_;
  std::vector<float> light_, blurred_;  ///< red, green, blue of each pixel
  std::vector<float> gain_;             ///< for each pixel
  std::vector<float> kernel_;           ///< weights of the blur, from its centre outwards
};

/// Converts a value of sRGB (0..255) to linear light (0..1), and back (IEC 61966-2-1).
float light_of(std::uint8_t value);
double value_of(double light);

}  // namespace muro::camera
