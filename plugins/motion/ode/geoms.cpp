// SPDX-License-Identifier: MIT
#include "geoms.hpp"

#include "muro/base/bounds.hpp"

namespace muro::ode {

dGeomID create_geom(const Shape& shape, const Pose& pose, dBodyID body, dSpaceID space, const OdeMeshes& meshes) {
  const Vec3& p = pose.position;
  if (shape.kind == ShapeKind::plane || shape.kind == ShapeKind::heightmap) {
    if (body) return nullptr;
    const Vec3 n = pose.orientation * Vec3::UnitZ();
    return dCreatePlane(space, n.x(), n.y(), n.z(), n.dot(p));
  }
  const dGeomID geom = shape.kind == ShapeKind::mesh
                           ? dCreateTriMesh(space, meshes.of(shape, body != nullptr)->data, nullptr, nullptr, nullptr)
                           : create_primitive(shape, space);
  dQuaternion orientation;
  copy_quaternion(orientation, pose.orientation);
  if (body) {
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, p.x(), p.y(), p.z());
    dGeomSetOffsetQuaternion(geom, orientation);
  } else {
    dGeomSetPosition(geom, p.x(), p.y(), p.z());
    dGeomSetQuaternion(geom, orientation);
  }
  return geom;
}

std::optional<Aabb> box_around(const Shape& shape, const OdeMeshes& meshes) {
  if (shape.kind == ShapeKind::plane || shape.kind == ShapeKind::heightmap) return {};
  if (shape.kind != ShapeKind::mesh) return bounds_of(shape, shape.origin);
  Aabb box;
  for (const Vec3& v : meshes.of(shape, true)->mesh.vertices) {
    const Vec3 p = shape.origin * v;
    box.include({p, p});
  }
  return box;
}

}  // namespace muro::ode
