// SPDX-License-Identifier: MIT
// Lines and points over a picture: a list of their own, which nothing that measures draws. To be made and used while
// the context is current.
#pragma once

#include <array>
#include <vector>

#include "camera.hpp"
#include "program.hpp"
#include "target.hpp"

namespace muro::render {

class Lines {
 public:
  Lines();
  ~Lines();
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  void clear();
  /// Places in the world, m; `color` 0..1; `cover`: 0 (not seen) .. 1.
  void add(const Vec3& from, const Vec3& to, const Vec3& color, double cover);
  void point(const Vec3& at, const Vec3& color);
  /// Behind what is nearer, into the target that was drawn last.
  void draw(const Camera& camera) const;

 private:
  struct End {
    Vec3 at;
    std::array<float, 4> color;
  };
  void draw(const Camera& camera, const std::vector<End>& ends, std::uint32_t kind) const;

  Program program_;
  std::vector<End> lines_, points_;
  std::uint32_t array_ = 0, buffer_ = 0;
};

}  // namespace muro::render
