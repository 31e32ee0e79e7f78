// SPDX-License-Identifier: MIT
// What contacts do, one by one: who answers for contacts writes it where somebody reads it.
#pragma once

#include "muro/key.hpp"
#include "muro/scene.hpp"

namespace muro {

/// One point in which two bodies touch, and what it does to the first of them; the other gets the opposite. Each
/// stands in one list.
struct ContactWrench {
  ObjectId body = no_object;
  ObjectId other = no_object;
  Vec3 point = Vec3::Zero();   ///< m, world
  Vec3 normal = Vec3::Zero();  ///< unit, world: the direction in which `body` is pushed
  double depth = 0;            ///< m: how far the bodies overlap along the normal; below 0 where they are apart
  Wrench wrench{};             ///< on `body`, at the point, world axes; not a number where it is not known
};
MURO_OPAQUE_TYPE(ContactWrench, "muro.ContactWrench", opaque);

namespace keys {

// Lists on the base of a robot that forces move; empty where nobody reads them.
/// Of the last step, by the engine that moves the robot.
inline constexpr Key<ContactWrench> contact_wrenches_of_motion{
    "contact.wrenches.motion", "m, N, N m", "list on the base of a robot: what its engine's contacts did to it"};
/// By the contact algorithm, for the step that begins.
inline constexpr Key<ContactWrench> contact_wrenches_of_law{
    "contact.wrenches.law", "m, N, N m", "list on the base of a robot: what the contact algorithm does to it"};

}  // namespace keys

}  // namespace muro
