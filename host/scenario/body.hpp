// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// Returns the inertia of a homogeneous solid of `mass` (kg).
Inertia homogeneous_inertia(const Shape& shape, double mass);

/// Returns the inertia of a homogeneous body of `mass` (kg): `body` stretched by the factors `scale` along its axes.
Inertia stretched_inertia(const Inertia& body, const Vec3& scale, double mass);

/// Returns a robot of one homogeneous body, named `body`. `mesh`: path of the mesh, for a shape that is one; `texture`:
/// path of a picture on the shape, or empty.
RobotTree single_body(const Shape& shape, const std::string& mesh, const std::string& texture, const Inertia& inertia);

}  // namespace muro::host
