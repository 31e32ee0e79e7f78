// SPDX-License-Identifier: MIT
#include "geoms.hpp"

namespace muro::ode {

dGeomID make_geom(const Shape& shape, const Pose& pose, dBodyID body, dSpaceID space, const Meshes& meshes) {
  const Vec3& s = shape.size;
  dGeomID geom = nullptr;
  switch (shape.kind) {
    case ShapeKind::box:
      geom = dCreateBox(space, s.x(), s.y(), s.z());
      break;
    case ShapeKind::sphere:
      geom = dCreateSphere(space, s.x());
      break;
    case ShapeKind::cylinder:
      geom = dCreateCylinder(space, s.x(), s.z());
      break;
    case ShapeKind::capsule:
      geom = dCreateCapsule(space, s.x(), s.z());
      break;
    case ShapeKind::plane: {
      if (body) return nullptr;
      const Vec3 n = pose.orientation * Vec3::UnitZ();
      return dCreatePlane(space, n.x(), n.y(), n.z(), n.dot(pose.position));
    }
    case ShapeKind::mesh:
      geom = dCreateTriMesh(space, meshes.of(shape, body != nullptr), nullptr, nullptr, nullptr);
      break;
  }
  const Vec3& p = pose.position;
  const Quat& q = pose.orientation;
  const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
  if (body) {
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, p.x(), p.y(), p.z());
    dGeomSetOffsetQuaternion(geom, turn);
  } else {
    dGeomSetPosition(geom, p.x(), p.y(), p.z());
    dGeomSetQuaternion(geom, turn);
  }
  return geom;
}

}  // namespace muro::ode
