// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "muro/connector.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::mujoco {

/// The convex hulls of all meshes that bodies of a scene collide with.
class Meshes {
 public:
  /// Reads them. Throws Error for a file that cannot be used. [setup]
  void load(const Connector& connector);
  /// m, in the frame of the shape; empty when it is no mesh.
  std::span<const Vec3> hull_of(const Shape& shape) const;

 private:
  using Key = std::tuple<TextId, double, double, double>;
  static Key key_of(const Shape& s) { return {s.mesh, s.size.x(), s.size.y(), s.size.z()}; }

  mesh::Store store_;
  std::map<Key, const mesh::Hull*> hulls_;
};

}  // namespace muro::mujoco
