// SPDX-License-Identifier: MIT
#include "image_pipeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "muro/base/elementary.hpp"
#include "plugins/common/mesh/srgb.hpp"

namespace muro::camera {

namespace {

const std::array<float, 256>& light_table() {
  static const std::array<float, 256> lights = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double v = double(i) / 255;
      t[i] = float(v <= 0.04045 ? v / 12.92 : elementary::pow((v + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return lights;
}

/// First number of the random draws for the noise of values.
constexpr std::uint32_t value_noise_draws = 1U << 30;

/// Returns value_of from a table, exact enough for integers.
float encode(double light) {
  static const std::vector<float> values = [] {
    std::vector<float> v(65536);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = float(value_of(double(i) / 65535));
    return v;
  }();
  return values[std::size_t(std::lround(65535 * (light > 0 ? std::min(light, 1.0) : 0)))];
}

}  // namespace

float light_of(std::uint8_t value) { return light_table()[value]; }

double value_of(double light) { return 255 * std::clamp(mesh::srgb_of(light), 0.0, 1.0); }

ImagePipeline::ImagePipeline(const render::Camera& c, const ImageSettings& settings)
    : settings_(settings), width_(c.width), height_(c.height), light_(std::size_t(3) * c.width * c.height) {
  for (std::uint32_t row = 0; row < height_; ++row)
    for (std::uint32_t column = 0; column < width_; ++column) {
      const double x = (column + 0.5 - c.cx) / c.fx, y = (row + 0.5 - c.cy) / c.fy, cos2 = 1 / (1 + x * x + y * y);
      gain_.push_back(float(elementary::exp2(settings_.exposure) * (1 - settings_.vignetting * (1 - cos2 * cos2))));
    }
  if (settings_.blur <= 0) return;
  double sum = 0;
  for (int k = 0; k <= int(std::ceil(4 * settings_.blur)); ++k) {
    const double weight = elementary::exp(-0.5 * k * k / (settings_.blur * settings_.blur));
    kernel_.push_back(float(weight));
    sum += k == 0 ? weight : 2 * weight;
  }
  for (float& w : kernel_) w = float(double(w) / sum);
}

void ImagePipeline::load(std::span<const std::uint8_t> rgb) {
  for (std::size_t i = 0; i < light_.size(); ++i) light_[i] = light_of(rgb[i]);
}

void ImagePipeline::load(std::span<const std::uint8_t> rgb, const LensMap& lens) {
  const std::uint32_t stride = lens.pinhole.width;
  for (std::size_t pixel = 0; pixel < lens.positions.size(); ++pixel) {
    const LensMap::Position& at = lens.positions[pixel];
    float* out = &light_[3 * pixel];
    if (at.column < 0) {
      std::fill_n(out, 3, 0.0F);
      continue;
    }
    const auto column = std::uint32_t(at.column), row = std::uint32_t(at.row);
    const float fx = at.column - float(column), fy = at.row - float(row);
    const std::uint8_t* p = &rgb[3 * (std::size_t(row) * stride + column)];
    for (std::size_t k = 0; k < 3; ++k) {
      const float upper = (1 - fx) * light_of(p[k]) + fx * light_of(p[3 + k]);
      const float lower = (1 - fx) * light_of(p[3 * stride + k]) + fx * light_of(p[3 * stride + 3 + k]);
      out[k] = (1 - fy) * upper + fy * lower;
    }
  }
}

/// Blurs along rows, then along columns. The outermost pixels are repeated beyond the sides.
void ImagePipeline::blur() {
  blurred_.resize(light_.size());
  const auto pass = [&](const std::vector<float>& from, std::vector<float>& to, std::uint32_t length,
                        std::uint32_t lines, std::size_t step, std::size_t next_line) {
    for (std::uint32_t line = 0; line < lines; ++line)
      for (std::uint32_t i = 0; i < length; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const float* start = &from[line * next_line + k];
          float sum = kernel_[0] * start[i * step];
          for (std::uint32_t d = 1; d < kernel_.size(); ++d) {
            const std::uint32_t before = i >= d ? i - d : 0, after = std::min(i + d, length - 1);
            sum += kernel_[d] * (start[before * step] + start[after * step]);
          }
          to[line * next_line + i * step + k] = sum;
        }
  };
  pass(light_, blurred_, width_, height_, 3, std::size_t(3) * width_);
  pass(blurred_, light_, height_, width_, std::size_t(3) * width_, 3);
}

void ImagePipeline::process(const Random& random, std::span<std::uint8_t> rgb) {
  for (std::size_t i = 0; i < light_.size(); ++i) light_[i] *= gain_[i / 3];
  if (!kernel_.empty()) blur();
  const bool noisy = settings_.noise > 0 || settings_.shot_noise > 0;
  NormalNumbers numbers(random, light_.size()), others(random, light_.size(), value_noise_draws);
  for (std::size_t i = 0; i < light_.size(); ++i) {
    double light = double(light_[i]);
    const double n = noisy ? numbers.next() : 0;
    if (settings_.shot_noise > 0) light = std::max(0.0, light + settings_.shot_noise * std::sqrt(light) * n);
    double value = double(encode(light));
    if (settings_.noise > 0) value += 255 * settings_.noise * (settings_.shot_noise > 0 ? others.next() : n);
    rgb[i] = std::uint8_t(std::lround(std::clamp(value, 0.0, 255.0)));
  }
}

}  // namespace muro::camera
