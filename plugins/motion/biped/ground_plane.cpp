// SPDX-License-Identifier: MIT
#include "ground_plane.hpp"

#include <string>
#include <vector>

#include "muro/shape.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::biped {

namespace {

constexpr double least_upward = 0.1;  ///< least z of the normal of a plane that may be the ground without being named

/// Parts of the scenery that could be the ground.
struct Grounds {
  std::vector<GroundPlane> planes;
  bool has_heightmaps = false;
};

Grounds grounds_of(const Connector& c) {
  Grounds found;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    const Pose body = c.constant(object, keys::pose).value_or(Pose{});
    ShapeOfObject where{object};
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
      found.has_heightmaps = found.has_heightmaps || s.kind == ShapeKind::heightmap;
      if (s.kind == ShapeKind::plane) {
        const Pose at = body * s.origin;
        const Vec3 normal = (at.orientation * Vec3::UnitZ()).normalized();
        found.planes.push_back({normal, normal.dot(at.position), where});
      }
      ++where.shape;
    }
  }
  return found;
}

std::string names_of(const Connector& c, const std::vector<GroundPlane>& planes) {
  std::vector<std::string_view> names;
  for (const GroundPlane& p : planes) names.push_back(c.object_name(p.shape.object));
  return quoted_list(names);
}

}  // namespace

GroundPlane find_ground_plane(const Connector& c, std::string_view name) {
  const Grounds found = grounds_of(c);
  if (name.empty()) {
    if (found.has_heightmaps)
      throw Error(
          "a biped puts its feet on a plane, and the scenery has a heightmap; take a motion by forces there, or name "
          "with `plane` the object whose plane it walks on whatever the heightmap does (" +
          names_of(c, found.planes) + ")");
    std::vector<GroundPlane> grounds = found.planes;  // without walls
    std::erase_if(grounds, [](const GroundPlane& p) { return p.normal.z() < least_upward; });
    if (grounds.size() == 1) return grounds.front();
    if (grounds.empty())
      throw Error(
          "the scenery has no plane on which a biped could put its feet; add an object with `shape: plane` to `world` "
          "(boxes and meshes are not taken for the ground)");
    throw Error("the scenery has " + std::to_string(grounds.size()) +
                " planes that look up; name with `plane` the one to walk on: " + names_of(c, grounds));
  }
  for (const GroundPlane& p : found.planes)
    if (c.object_name(p.shape.object) == name) return p;
  throw Error("plane: there is no object " + quote(name) + " of the scenery with a plane among its collision shapes; " +
              "there are: " + names_of(c, found.planes));
}

}  // namespace muro::biped
