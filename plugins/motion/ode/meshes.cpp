// SPDX-License-Identifier: MIT
#include "meshes.hpp"

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro::ode {

static_assert(sizeof(mesh::Triangle) == 3 * sizeof(dTriIndex) && sizeof(Vec3) == 3 * sizeof(double));

Meshes::Surface::Surface(mesh::Mesh of_file) : mesh(std::move(of_file)), data(dGeomTriMeshDataCreate()) {
  dGeomTriMeshDataBuildDouble(data, mesh.vertices.data(), sizeof(Vec3), int(mesh.vertices.size()),
                              mesh.triangles.data(), int(3 * mesh.triangles.size()), sizeof(mesh::Triangle));
}

void Meshes::load(const Connector& c, bool exact) {
  exact_ = exact;
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) {
      if (s.kind != ShapeKind::mesh) continue;
      const bool hull = !exact || c.robot_of(ObjectId{i}) >= 0;
      std::unique_ptr<Surface>& surface = surfaces_[name_of(s, hull)];
      if (surface) continue;
      const std::string path(c.text(s.mesh));
      try {
        surface =
            std::make_unique<Surface>(hull ? mesh::surface_of(store_.hull(path, s.size)) : store_.mesh(path, s.size));
      } catch (const Error& error) {
        throw Error("`" + std::string(c.object_name(ObjectId{i})) + "`: " + error.what());
      }
    }
}

dTriMeshDataID Meshes::of(const Shape& shape, bool moves) const {
  return surfaces_.at(name_of(shape, moves || !exact_))->data;
}

}  // namespace muro::ode
