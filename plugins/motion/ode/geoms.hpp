// SPDX-License-Identifier: MIT
// Collision shapes of ODE.
#pragma once

#include <optional>

#include "muro/scene.hpp"
#include "ode_meshes.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::ode {

/// The owner of a geom; dGeomGetData returns it.
struct GeomOwner {
  std::uint32_t number = 0;       ///< number of the geom: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;        ///< robot of this world; -1: an external body
  std::uint32_t body = 0;         ///< body of the robot
  std::uint32_t loaded_link = 0;  ///< see BodyShape
  Surface surface;
  contact_geometry::ShapeExtent extent{};
  const std::string* scenery = nullptr;   ///< its name; null for moving bodies and for meshes (no depth)
  ObjectId object = no_object;            ///< object that has the shape
  terrain_contact::ConvexShape convex{};  ///< for a robot: shape that touches heightmaps
  bool is_terrain = false;                ///< a heightmap at `pose`
  Heightmap heightmap{};
  Pose pose{};
};

/// Creates a geom in `space` (null: in no space). `pose`: pose of the shape in the world, or from the centre of mass of
/// `body`. Returns null for shapes that ODE cannot place: a plane or heightmap on a body. A heightmap becomes a plane
/// of ODE that only represents it in contacts: ODE's own heightfield takes a cell as one plane and has no ridges.
dGeomID create_geom(const Shape& shape, const Pose& pose, dBodyID body, dSpaceID space, const OdeMeshes& meshes);

/// Returns the box around a shape of a robot, in the axes of its body; nothing for a shape without bounds.
std::optional<Aabb> box_around(const Shape& shape, const OdeMeshes& meshes);

}  // namespace muro::ode
