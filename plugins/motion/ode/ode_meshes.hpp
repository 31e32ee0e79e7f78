// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "plugins/common/engines/ode/ode_library.hpp"
#include "plugins/motion/common/multibody/mesh_shapes.hpp"

namespace muro::ode {

/// Triangles for ODE. ODE points to them, so they keep their addresses.
struct TriangleMesh {
  explicit TriangleMesh(mesh::Mesh of_file) : mesh(std::move(of_file)), data(dGeomTriMeshDataCreate()) {
    static_assert(sizeof(mesh::Triangle) == 3 * sizeof(dTriIndex) && sizeof(Vec3) == 3 * sizeof(double));
    dGeomTriMeshDataBuildDouble(data, mesh.vertices.data(), sizeof(Vec3), int(mesh.vertices.size()),
                                mesh.triangles.data(), int(3 * mesh.triangles.size()), sizeof(mesh::Triangle));
  }
  ~TriangleMesh() { dGeomTriMeshDataDestroy(data); }
  TriangleMesh(const TriangleMesh&) = delete;
  TriangleMesh& operator=(const TriangleMesh&) = delete;

  mesh::Mesh mesh;
  dTriMeshDataID data;
};

using OdeMeshes = multibody::MeshShapes<std::unique_ptr<TriangleMesh>>;

}  // namespace muro::ode
