// SPDX-License-Identifier: MIT
// OpenGL used directly: the cost of the z-buffer without muro.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plugins/common/render/surface.hpp"

namespace muro::bench {

/// Draws boxes and cylinders into a depth buffer of its own, and reads it back.
class BareDepth {
 public:
  /// Draws on the processor, in the calling thread.
  BareDepth(std::uint32_t width, std::uint32_t height, const render::Surface& cylinder);
  ~BareDepth();
  BareDepth(const BareDepth&) = delete;
  BareDepth& operator=(const BareDepth&) = delete;

  /// Matrix of 3x4 by rows: from the unit box, or the cylinder of radius 1 and length 1, to the frame of the camera.
  using Transform = std::array<float, 12>;
  struct Instances {
    std::vector<Transform> boxes, cylinders;
  };
  /// `projection`: from the frame of the camera to clip space. The result is in depths().
  void draw(const Eigen::Matrix4f& projection, const Instances& instances);
  std::span<const float> depths() const { return depths_; }

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::uint32_t width_, height_;
  std::uint32_t program_ = 0, array_ = 0, corners_ = 0, indices_ = 0, transforms_ = 0, buffer_ = 0, framebuffer_ = 0;
  std::uint32_t box_indices_ = 0, box_corners_ = 0, cylinder_indices_ = 0;
  std::vector<float> depths_;
};

}  // namespace muro::bench
