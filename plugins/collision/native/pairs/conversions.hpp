// SPDX-License-Identifier: MIT
#pragma once

#include "lanes/kernel_shape.hpp"
#include "plugins/common/contact_geometry/transformed_shape.hpp"

namespace muro::native {

using namespace contact_geometry;
using contact_geometry::transformed;

/// Returns the shape as plain numbers, on body number `body` of its robot.
KernelShape kernel_shape_of(const Shape& shape, std::uint32_t body = 0);
/// Returns a mesh or heightmap as plain numbers. `box`: the box around it, in its own frame.
KernelShape kernel_shape_of(const Shape& shape, const Aabb& box, std::uint32_t body);
/// Returns the shape in the world, with the bits that kernels compute. `body`: pose of its body.
TransformedShape transformed(const KernelShape& shape, const Pose& body);
GroundPlane ground_plane_of(const TransformedShape& plane);

}  // namespace muro::native
