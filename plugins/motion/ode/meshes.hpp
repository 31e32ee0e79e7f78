// SPDX-License-Identifier: MIT
#pragma once

#include <ode/ode.h>

#include <map>
#include <memory>

#include "muro/connector.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::ode {

/// The triangles of all meshes in a scene, as ODE takes them.
class Meshes {
 public:
  /// Reads the meshes of all collision shapes; `exact`: scenery collides as it is, else as its convex hull, as robots
  /// always do. Throws Error with the file that cannot be read, or has no hull. [setup]
  void load(const Connector& c, bool exact);
  /// Of a shape of kind mesh.
  dTriMeshDataID of(const Shape& shape, bool moves) const;

 private:
  /// Kept where it is: ODE refers to it.
  struct Surface {
    explicit Surface(mesh::Mesh of_file);
    ~Surface() { dGeomTriMeshDataDestroy(data); }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    mesh::Mesh mesh;
    dTriMeshDataID data;
  };
  /// Which file, at which scale, as its hull or as it is.
  struct Name {
    TextId file;
    double x, y, z;
    bool hull;
    auto operator<=>(const Name&) const = default;
  };
  static Name name_of(const Shape& s, bool hull) { return {s.mesh, s.size.x(), s.size.y(), s.size.z(), hull}; }

  bool exact_ = false;
  mesh::Store store_;
  std::map<Name, std::unique_ptr<Surface>> surfaces_;
};

}  // namespace muro::ode
