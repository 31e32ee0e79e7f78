// SPDX-License-Identifier: MIT
#include "hull_vertices.hpp"

#include "hull.hpp"

namespace muro::mesh {

std::vector<Vec3> hull_vertices(const Connector& c, const Shape& shape) {
  Mesh mesh;
  try {
    mesh = load(std::string(c.text(shape.mesh)), shape.size);
    return convex_hull(mesh.vertices).vertices;
  } catch (const Error&) {
    return mesh.vertices;
  }
}

}  // namespace muro::mesh
