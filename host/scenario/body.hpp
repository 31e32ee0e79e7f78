// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// Inertia of a homogeneous solid.
Inertia homogeneous_inertia(const Shape& shape, double mass);

/// The inertia of a homogeneous body of `mass` (kg) that is another one, stretched by the factors `scale` along its
/// axes.
Inertia stretched_inertia(const Inertia& body, const Vec3& scale, double mass);

/// A robot of one homogeneous body, named `body`. `mesh`: the path, of a shape that is a mesh; `texture`: that of a
/// picture on the shape, or empty.
RobotTree single_body(const Shape& shape, const std::string& mesh, const std::string& texture, const Inertia& inertia);

}  // namespace muro::host
