// SPDX-License-Identifier: MIT
// Contacts of each kind of shape with a heightmap, in its frame.
#pragma once

#include "contact_collector.hpp"
#include "surface.hpp"

namespace muro::terrain_contact {

/// Adds contacts of all points within `radius` (m) of the segment from `a` to `b`, which may be one point.
void add_round_contacts(const Surface& surface, const Vec3& a, const Vec3& b, double radius,
                        ContactCollector& contacts);
/// Adds contacts of a box. `pose`: in the frame of the heightmap; `box`: around the shape there.
void add_box_contacts(const Surface& surface, const Vec3& size, const Pose& pose, const Aabb& box,
                      ContactCollector& contacts);
void add_hull_contacts(const Surface& surface, const mesh::Hull& hull, const Pose& pose, const Aabb& box,
                       ContactCollector& contacts);
void add_cylinder_contacts(const Surface& surface, double radius, double length, const Pose& pose, const Aabb& box,
                           ContactCollector& contacts);

}  // namespace muro::terrain_contact
