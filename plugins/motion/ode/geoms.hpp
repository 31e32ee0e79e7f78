// SPDX-License-Identifier: MIT
// Shapes as ODE collides them.
#pragma once

#include <ode/ode.h>

#include "meshes.hpp"
#include "plugins/common/multibody/world.hpp"

namespace muro::ode {

/// What a geom belongs to, found again by dGeomGetData.
struct Owner {
  std::uint32_t number = 0;  ///< of the geom: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;   ///< of this world; -1: a fixture
  std::uint32_t part = 0;
  std::uint32_t body = 0;  ///< of the model, see PartShape
  double friction = 0, restitution = 0;
};

/// The shape in `space` (null: in none), at `pose`: of the shape in the world, or, with a body, from its centre of
/// mass. Null for what ODE cannot place: a plane on a body.
dGeomID make_geom(const Shape& shape, const Pose& pose, dBodyID body, dSpaceID space, const Meshes& meshes);

inline Vec3 vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Quat quaternion_of(const dReal* q) { return Quat(q[0], q[1], q[2], q[3]); }

}  // namespace muro::ode
