// SPDX-License-Identifier: MIT
#pragma once

#include "lanes/solid.hpp"
#include "plugins/common/contact_geometry/placed.hpp"

namespace muro::native {

using namespace encounters;
using encounters::placed;

/// The same as plain numbers, number `body` of its robot.
Solid solid_of(const Shape& shape, std::uint32_t body = 0);
/// No point of the shape is farther (m) from its body's origin; planes and meshes have no end.
double reach_of(const Solid& solid);
/// The shape whose body is at `body`, with the bits that kernels work with.
Placed placed(const Solid& solid, const Pose& body);
/// The plane's surface.
Ground ground_of(const Placed& plane);

}  // namespace muro::native
