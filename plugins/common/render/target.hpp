// SPDX-License-Identifier: MIT
// Targets of drawing, from which images are read back. Must be made and used while the context is current.
#pragma once

#include <cstdint>
#include <span>

namespace muro::render {

/// A colour image: several samples for each pixel, averaged in linear light.
class ColorTarget {
 public:
  /// Takes fewer samples if the driver does not have as many.
  ColorTarget(std::uint32_t width, std::uint32_t height, std::uint32_t samples_per_pixel = 4);
  ~ColorTarget();
  ColorTarget(const ColorTarget&) = delete;
  ColorTarget& operator=(const ColorTarget&) = delete;

  std::uint32_t samples() const { return samples_; }
  void begin() const;
  /// Reads sRGB, as many rows of `width` pixels as fit, from the top.
  void read(std::span<std::uint8_t> rgb) const;
  /// Copies the image to the window whose context is current.
  void show() const;

 private:
  void resolve() const;

  std::uint32_t width_, height_;
  std::uint32_t samples_ = 1;               ///< for each pixel
  std::uint32_t drawn_ = 0, resolved_ = 0;  ///< framebuffers
  std::uint32_t buffers_[3] = {};
};

/// Depths and, on request, labels, with one sample in the centre of each pixel.
class DepthTarget {
 public:
  DepthTarget(std::uint32_t width, std::uint32_t height, bool labels);
  ~DepthTarget();
  DepthTarget(const DepthTarget&) = delete;
  DepthTarget& operator=(const DepthTarget&) = delete;

  bool has_labels() const { return buffers_[1] != 0; }
  /// Clears the target and directs all following drawing to it.
  void begin() const;
  /// Reads the depth buffer: near / distance along the axis, 0 where nothing was drawn. Reads as many rows of `width`
  /// pixels as fit, from the top.
  void read(std::span<float> inverse) const;
  /// Reads the label of each pixel, 0xffffffff where nothing was drawn, in the same order.
  void read(std::span<std::uint32_t> labels) const;

 private:
  std::uint32_t width_, height_;
  std::uint32_t drawn_ = 0;
  std::uint32_t buffers_[2] = {};
};

}  // namespace muro::render
