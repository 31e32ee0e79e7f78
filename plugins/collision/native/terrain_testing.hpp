// SPDX-License-Identifier: MIT
// Heightmaps for tests of the narrow phase.
#pragma once

#include <functional>
#include <memory>

#include "pairs_testing.hpp"
#include "terrain/collide_terrain.hpp"

namespace muro::native::testing {

/// A heightmap at a pose, with heights given by a function.
struct Ground {
  std::vector<float> values;
  Heightmap map;
  std::unique_ptr<Terrain> terrain;

  /// `size_x`, `size_y`: m.
  Ground(double size_x, double size_y, std::uint32_t columns, std::uint32_t rows,
         const std::function<double(double, double)>& height, const Pose& pose = {}, double radius = 3) {
    map = {{}, columns, rows, {size_x, size_y, 1}};
    values.resize(std::size_t(columns) * rows);
    map.values = values;
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const Vec3 p = map.node(c, r);
        values[std::size_t(r) * columns + c] = float(height(p.x(), p.y()));
      }
    terrain = std::make_unique<Terrain>(map, pose, radius);
  }
  std::vector<ContactPoint> contacts(const TransformedShape& shape) const {
    std::vector<ContactPoint> points;
    collide_terrain(shape, *terrain, points);
    return points;
  }
  /// Returns the farthest (m) that a contact requires the shape to be lifted.
  double lift(const TransformedShape& shape) const {
    double most = 0;
    for (const ContactPoint& p : contacts(shape)) most = std::max(most, p.depth / p.normal.z());
    return most;
  }
};

/// Hills that are gentle for wheels, with cells of 0.5 m by default.
inline Ground hills(std::uint32_t nodes = 25) {
  return Ground(12, 12, nodes, nodes,
                [](double x, double y) { return 0.4 * std::sin(0.7 * x + 0.3) * std::cos(0.6 * y); });
}
/// Rocks: each node has its own random height.
inline Ground rocks(unsigned seed) {
  Randoms random(seed);
  return Ground(12, 12, 25, 25, [&](double, double) { return random.uniform(0, 0.3); });
}

}  // namespace muro::native::testing
