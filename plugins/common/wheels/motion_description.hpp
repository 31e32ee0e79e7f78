// SPDX-License-Identifier: MIT
// Properties that motions and drives of wheeled vehicles name in their descriptions.
#pragma once

#include "muro/description.hpp"

namespace muro::wheels {

inline constexpr PropertyUse reads_initial_pose{"pose.initial", "of the base"};
inline constexpr PropertyUse reads_initial_twist{
    "twist.initial", "of the base; what wheels can follow of it is their speed at the start"};
inline constexpr PropertyUse reads_initial_positions{"joint.position.initial", "of every joint, optional"};
inline constexpr PropertyUse reads_wheel_shapes{"collision.shapes", "of the wheels; else visual.shapes"};

}  // namespace muro::wheels
