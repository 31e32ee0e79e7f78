// SPDX-License-Identifier: MIT
// Debug drawing: lines and points over an image, which no sensor sees. Must be made and used while the context is
// current.
#pragma once

#include <array>
#include <vector>

#include "camera.hpp"
#include "program.hpp"
#include "target.hpp"

namespace muro::render {

class DebugLines {
 public:
  DebugLines();
  ~DebugLines();
  DebugLines(const DebugLines&) = delete;
  DebugLines& operator=(const DebugLines&) = delete;

  void clear();
  /// Adds a line. Positions in the world, m; `color` 0..1; `alpha`: 0 (not seen) .. 1.
  void add_line(const Vec3& from, const Vec3& to, const Vec3& color, double alpha);
  void add_point(const Vec3& at, const Vec3& color);
  /// Draws into the last target; nearer surfaces hide lines and points.
  void draw(const Camera& camera) const;

 private:
  struct ColoredPoint {
    Vec3 position;
    std::array<float, 4> color;
  };
  void draw(const Camera& camera, const std::vector<ColoredPoint>& ends, std::uint32_t primitive) const;

  Program program_;
  std::vector<ColoredPoint> lines_, points_;
  std::uint32_t vertex_array_ = 0, vertex_buffer_ = 0;
};

}  // namespace muro::render
