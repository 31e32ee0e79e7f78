// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// Inertia of a homogeneous solid.
Inertia homogeneous_inertia(const Shape& shape, double mass);

/// A robot of one homogeneous body, named `body`.
RobotTree single_body(const Shape& shape, double mass);

}  // namespace muro::host
