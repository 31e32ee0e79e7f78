// SPDX-License-Identifier: MIT
#include "terrain_contacts.hpp"

#include "muro/base/bounds.hpp"
#include "shape_contacts.hpp"

namespace muro::terrain_contact {

namespace {

/// Returns the box around a shape. `pose`: in the frame of the heightmap.
Aabb box_around(const ConvexShape& shape, const Pose& pose) {
  if (!shape.hull) return bounds_of({.kind = shape.kind, .size = shape.size}, pose);
  Aabb box;
  for (const Vec3& v : shape.hull->vertices) {
    const Vec3 p = pose * v;
    box.include({p, p});
  }
  return box;
}

}  // namespace

int find_contacts(const Heightmap& map, const Pose& map_pose, const ConvexShape& shape, double margin,
                  TerrainContacts& contacts) {
  const Pose pose = map_pose.inverse() * shape.pose;
  if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite()) return 0;
  Aabb box = box_around(shape, pose);
  if (box.low.x() > 0.5 * map.size.x() || box.high.x() < -0.5 * map.size.x() || box.low.y() > 0.5 * map.size.y() ||
      box.high.y() < -0.5 * map.size.y())
    return 0;
  ContactCollector found(margin, (box.high - box.low).norm());
  box.low.array() -= margin;
  box.high.array() += margin;
  const Surface surface(map);
  const double radius = shape.size.x();
  switch (shape.kind) {
    case ShapeKind::box:
      add_box_contacts(surface, shape.size, pose, box, found);
      break;
    case ShapeKind::sphere:
      add_round_contacts(surface, pose.position, pose.position, radius, found);
      break;
    case ShapeKind::capsule: {
      const Vec3 half = pose.orientation * Vec3(0, 0, 0.5 * shape.size.z());
      add_round_contacts(surface, pose.position - half, pose.position + half, radius, found);
      break;
    }
    case ShapeKind::cylinder:
      add_cylinder_contacts(surface, radius, shape.size.z(), pose, box, found);
      break;
    case ShapeKind::mesh:
      if (shape.hull) add_hull_contacts(surface, *shape.hull, pose, box, found);
      break;
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      break;
  }
  return found.take(map_pose, contacts);
}

}  // namespace muro::terrain_contact
