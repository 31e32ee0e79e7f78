// SPDX-License-Identifier: MIT
// Heightmaps of functions, for tests of bodies on them.
#pragma once

#include <cstring>
#include <functional>

#include "muro/toolkit/heightmap.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::test {

/// A square heightmap in a file of its own. A function gives the heights at its nodes (to the last digit of a float).
class Hills {
 public:
  using Heights = std::function<double(double x, double y)>;

  /// `side`: m, of the square about the origin; `cells`: number along each side.
  Hills(double side, int cells, const Heights& height) : columns_(std::uint32_t(cells) + 1), size_(side, side, 1) {
    for (int row = 0; row <= cells; ++row)
      for (int column = 0; column <= cells; ++column)
        values_.push_back(float(height(side * column / cells - 0.5 * side, side * row / cells - 0.5 * side)));
    std::string bytes(values_.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values_.data(), bytes.size());
    path_ = folder_.file("hills.r32", bytes);
  }

  const std::string& path() const { return path_; }
  Heightmap heightmap() const { return {values_, columns_, columns_, size_}; }
  /// `others`: further shapes of the same object.
  void add_to(Simulation& scene, const Pose& pose = {}, std::vector<Shape> others = {}) const {
    others.push_back({.kind = ShapeKind::heightmap, .mesh = scene.world().intern(path_), .size = size_});
    scene.world().add_scenery("hills", pose, std::span<const Shape>(others));
  }

 private:
  ScratchFolder folder_;
  std::string path_;
  std::vector<float> values_;
  std::uint32_t columns_;
  Vec3 size_;
};

}  // namespace muro::test
