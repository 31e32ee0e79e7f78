// SPDX-License-Identifier: MIT
// Where pictures go, and how they come back. To be made and used while the context is current.
#pragma once

#include <cstdint>
#include <span>

namespace muro::render {

/// A picture in colours: some samples a pixel, mixed in light, not in what a screen is told.
class ColorTarget {
 public:
  ColorTarget(std::uint32_t width, std::uint32_t height, std::uint32_t samples = 4);
  ~ColorTarget();
  ColorTarget(const ColorTarget&) = delete;
  ColorTarget& operator=(const ColorTarget&) = delete;

  void begin() const;
  /// sRGB, as many rows of `width` pixels as fit, from the top.
  void read(std::span<std::uint8_t> rgb) const;
  /// Into the window whose context is current.
  void show() const;

 private:
  void mix() const;

  std::uint32_t width_, height_;
  std::uint32_t drawn_ = 0, mixed_ = 0;  ///< framebuffers
  std::uint32_t buffers_[3] = {};
};

/// Distances, and, on request, whose they are: one sample in the middle of each pixel.
class DepthTarget {
 public:
  DepthTarget(std::uint32_t width, std::uint32_t height, bool labels);
  ~DepthTarget();
  DepthTarget(const DepthTarget&) = delete;
  DepthTarget& operator=(const DepthTarget&) = delete;

  bool has_labels() const { return buffers_[1] != 0; }
  /// Everything empty; what is drawn from now on comes here.
  void begin() const;
  /// What the depth buffer holds, near / distance along the axis, or 0; as many rows of `width` as fit, from the top.
  void read(std::span<float> inverse) const;
  /// The label of each pixel, or 0xffffffff; likewise.
  void read(std::span<std::uint32_t> labels) const;

 private:
  std::uint32_t width_, height_;
  std::uint32_t drawn_ = 0;
  std::uint32_t buffers_[2] = {};
};

}  // namespace muro::render
