// SPDX-License-Identifier: MIT
// Contacts with a plane in closed form, all corners at once. Bullet's algorithm gives one point per step and collects
// the others over several steps.
#pragma once

#include "narrow_phase.hpp"

namespace muro::bullet {

/// Finds the points in which `a` is within NarrowPhase::margin of the plane z = 0 of `plane`, which is solid below.
/// These are the lowest points of a box (four), a cylinder (four of the lower rim, one of the upper), a capsule (two),
/// a sphere (one) or a hull (eight). Returns their number.
int plane_contacts(const Collider& a, const btTransform& plane, ContactPoint* out);

}  // namespace muro::bullet
