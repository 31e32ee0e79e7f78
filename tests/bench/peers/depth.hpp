// SPDX-License-Identifier: MIT
// OpenGL used directly: what the z-buffer costs without muro.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::bench {

/// Boxes drawn into a depth buffer of their own size, and read back.
class BareDepth {
 public:
  /// By the processor, in the calling thread.
  BareDepth(std::uint32_t width, std::uint32_t height);
  ~BareDepth();
  BareDepth(const BareDepth&) = delete;
  BareDepth& operator=(const BareDepth&) = delete;

  /// A box as a 3x4 matrix by rows, from the unit box to places about the eye.
  using Box = std::array<float, 12>;
  /// `projection` from places about the eye; what was drawn is then in depths().
  void draw(const Eigen::Matrix4f& projection, std::span<const Box> boxes);
  std::span<const float> depths() const { return depths_; }

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::uint32_t width_, height_;
  std::uint32_t program_ = 0, array_ = 0, cube_ = 0, indices_ = 0, boxes_ = 0, buffer_ = 0, framebuffer_ = 0;
  std::vector<float> depths_;
};

}  // namespace muro::bench
