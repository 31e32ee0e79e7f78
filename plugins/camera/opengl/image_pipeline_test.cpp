// SPDX-License-Identifier: MIT
#include "image_pipeline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muro::camera {
namespace {

const Random noise(1, 2, 3);

/// Returns a processed grey picture with this value in all pixels.
std::vector<std::uint8_t> processed(const render::Camera& camera, const ImageSettings& settings, std::uint8_t value) {
  ImagePipeline pipeline(camera, settings);
  std::vector<std::uint8_t> rgb(std::size_t(3) * camera.width * camera.height, value);
  pipeline.load(rgb);
  pipeline.process(noise, rgb);
  return rgb;
}

TEST(ImagePipeline, KnowsTheCurveOfSrgb) {
  EXPECT_EQ(light_of(0), 0);
  EXPECT_EQ(light_of(255), 1);
  EXPECT_NEAR(light_of(188), 0.5029, 1e-3) << "half of the light";
  for (int v = 0; v < 256; ++v) EXPECT_NEAR(value_of(double(light_of(std::uint8_t(v)))), v, 1e-4);
}

TEST(ImagePipeline, LeavesAPictureAsItIs) {
  const render::Camera camera = render::Camera::of_fov(8, 8, 1);
  for (const int v : {0, 1, 17, 128, 254, 255}) EXPECT_EQ(processed(camera, {}, std::uint8_t(v))[3], v);
}

TEST(ImagePipeline, DoublesLightWithEachStop) {
  const render::Camera camera = render::Camera::of_fov(8, 8, 1);
  const std::uint8_t brighter = processed(camera, {.exposure = 1}, 100)[0];
  EXPECT_NEAR(double(light_of(brighter)), 2 * double(light_of(100)), 2e-3);
  EXPECT_EQ(processed(camera, {.exposure = 10}, 100)[0], 255) << "white is the end";
}

TEST(ImagePipeline, DimsByTheFourthPowerOfTheCosine) {
  const render::Camera camera = render::Camera::of_fov(101, 101, 1.6);
  const auto picture = processed(camera, {.vignetting = 1}, 230);
  for (const std::uint32_t column : {50u, 70u, 100u}) {
    const double x = (column + 0.5 - 50.5) / camera.fx, cosine = 1 / std::sqrt(1 + x * x);
    EXPECT_NEAR(double(light_of(picture[3 * (50 * 101 + column)])), double(light_of(230)) * std::pow(cosine, 4), 4e-3);
  }
}

TEST(ImagePipeline, BlursAnEdgeToTheIntegralOfAGaussian) {
  const render::Camera camera = render::Camera::of_fov(60, 20, 1);
  for (const double sigma : {0.7, 2.0, 4.0}) {
    ImagePipeline pipeline(camera, {.blur = sigma});
    std::vector<std::uint8_t> rgb(60 * 20 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = (i / 3) % 60 < 30 ? 0 : 255;
    pipeline.load(rgb);
    pipeline.process(noise, rgb);
    for (std::uint32_t column = 20; column < 40; ++column) {
      const double x = column - 29.5;  // pixels beyond the edge, at the middle of the pixel
      const double expected = 0.5 * (1 + std::erf(x / (sigma * std::sqrt(2.0))));
      EXPECT_NEAR(double(light_of(rgb[3 * (10 * 60 + column)])), expected, sigma < 1 ? 0.03 : 0.01) << column;
    }
  }
}

double deviation(const std::vector<std::uint8_t>& picture, double mean) {
  double sum = 0;
  for (const std::uint8_t v : picture) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / double(picture.size()));
}

TEST(ImagePipeline, AddsNoiseOfTheDeviationThatIsAskedFor) {
  const render::Camera camera = render::Camera::of_fov(100, 100, 1);
  const auto picture = processed(camera, {.noise = 0.02}, 128);
  double mean = 0;
  for (const std::uint8_t v : picture) mean += v / double(picture.size());
  EXPECT_NEAR(mean, 128, 0.2);
  EXPECT_NEAR(deviation(picture, 128), std::sqrt(0.02 * 255 * 0.02 * 255 + 1 / 12.0), 0.1);
}

TEST(ImagePipeline, HasShotNoiseThatGrowsWithTheRootOfTheLight) {
  const render::Camera camera = render::Camera::of_fov(100, 100, 1);
  for (const int v : {90, 150, 210}) {
    const auto picture = processed(camera, {.shot_noise = 0.02}, std::uint8_t(v));
    double sum = 0;
    const double light = double(light_of(std::uint8_t(v)));
    for (const std::uint8_t value : picture) sum += std::pow(double(light_of(value)) - light, 2);
    EXPECT_NEAR(std::sqrt(sum / double(picture.size())), 0.02 * std::sqrt(light),
                0.05 * 0.02 * std::sqrt(light) + 3e-4);
  }
}

TEST(ImagePipeline, HasTheSameNoiseForTheSameDice) {
  const render::Camera camera = render::Camera::of_fov(20, 20, 1);
  const ImageSettings settings{.noise = 0.02, .shot_noise = 0.01};
  EXPECT_EQ(processed(camera, settings, 128), processed(camera, settings, 128));
}

}  // namespace
}  // namespace muro::camera
