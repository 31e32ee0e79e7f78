// SPDX-License-Identifier: MIT
// Shapes as ODE collides them.
#pragma once

#include <optional>

#include "muro/scene.hpp"
#include "ode_meshes.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::ode {

/// What a geom belongs to, found again by dGeomGetData.
struct GeomOwner {
  std::uint32_t number = 0;       ///< of the geom: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;        ///< of this world; -1: an external body
  std::uint32_t body = 0;         ///< of the robot
  std::uint32_t loaded_link = 0;  ///< see BodyShape
  Surface surface;
  contact_geometry::ShapeExtent extent{};
  const std::string* scenery = nullptr;   ///< its name; null for what moves, and for meshes, whose depths are none
  ObjectId object = no_object;            ///< that has the shape
  terrain_contact::ConvexShape convex{};  ///< of a robot: what touches heightmaps
  bool is_terrain = false;                ///< a heightmap, which is at `pose`
  Heightmap heightmap{};
  Pose pose{};
};

/// The shape in `space` (null: in none), at `pose`: of the shape in the world, or, with a body, from its centre of
/// mass. Null for what ODE cannot place: a plane or heightmap on a body. A heightmap is a plane to ODE, which only
/// stands for it in contacts: ODE's own heightfield takes a cell for one plane, and knows no ridges.
dGeomID create_geom(const Shape& shape, const Pose& pose, dBodyID body, dSpaceID space, const OdeMeshes& meshes);

/// The box around a shape of a robot, in the axes of its body; none where it has no bounds.
std::optional<Aabb> box_around(const Shape& shape, const OdeMeshes& meshes);

}  // namespace muro::ode
