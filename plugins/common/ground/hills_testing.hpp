// SPDX-License-Identifier: MIT
// Heightmaps of functions, for tests of what goes on them.
#pragma once

#include <cstring>
#include <functional>

#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::ground {

/// A square heightmap on a file of its own, as high as a function says at its nodes (to the last digit of a float).
class Hills {
 public:
  using Heights = std::function<double(double x, double y)>;

  /// `side`: m, of the square about the origin; `cells` along each of its sides.
  Hills(double side, int cells, const Heights& height) {
    const int nodes = cells + 1;
    std::string bytes(std::size_t(nodes) * std::size_t(nodes) * 4, '\0');
    for (int row = 0; row < nodes; ++row)
      for (int column = 0; column < nodes; ++column) {
        const float value = float(height(side * column / cells - 0.5 * side, side * row / cells - 0.5 * side));
        std::memcpy(bytes.data() + 4 * (std::size_t(row) * std::size_t(nodes) + std::size_t(column)), &value, 4);
      }
    path_ = folder_.file("hills.r32", bytes);
    size_ = {side, side, 1};
  }

  const std::string& path() const { return path_; }
  void add_to(Simulation& scene, const Pose& pose = {}) const {
    const Shape shape{.kind = ShapeKind::heightmap, .mesh = scene.world().intern(path_), .size = size_};
    scene.world().add_scenery("hills", pose, std::span<const Shape>(&shape, 1));
  }

 private:
  test::ScratchFolder folder_;
  std::string path_;
  Vec3 size_;
};

}  // namespace muro::ground
