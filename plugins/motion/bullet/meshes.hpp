// SPDX-License-Identifier: MIT
// Shapes of Bullet made from mesh files.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <map>
#include <memory>
#include <vector>

#include "muro/connector.hpp"
#include "muro/shape.hpp"

namespace muro::bullet {

/// The meshes of a scene, each file read once. They outlive the worlds that collide them.
class Meshes {
 public:
  /// Reads the meshes of all objects of the scene. `exact`: those of scenery stay as they are; all others become their
  /// convex hulls. Throws Error for a file that cannot be read. [setup]
  void load(const Connector& c, bool exact);

  /// As the convex hull, or, for scenery, as load() was told.
  std::shared_ptr<btCollisionShape> hull(const Shape& shape) const;
  std::shared_ptr<btCollisionShape> scenery(const Shape& shape) const;

 private:
  using Key = std::tuple<std::uint32_t, double, double, double>;
  /// What a triangle mesh of Bullet points into.
  struct Triangles {
    std::vector<double> vertices;
    std::vector<int> corners;
    std::unique_ptr<btTriangleIndexVertexArray> view;
    std::unique_ptr<btCollisionShape> shape;
  };
  static Key key_of(const Shape& shape);

  std::map<Key, std::shared_ptr<btCollisionShape>> hulls_, exact_;
};

}  // namespace muro::bullet
