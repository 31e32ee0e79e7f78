// SPDX-License-Identifier: MIT
// What motions of wheeled vehicles say of themselves.
#pragma once

#include "muro/description.hpp"

namespace muro::wheeled {

inline constexpr PropertyUse motion_writes[] = {{"pose", "of the base"},
                                                {"twist", "of the base"},
                                                {"joint.position", "of every joint"},
                                                {"joint.velocity", "of every joint"}};
inline constexpr PropertyUse starts_at{"pose.initial", "of the base"};
inline constexpr PropertyUse starts_with{"twist.initial",
                                         "of the base; what wheels can follow of it is their speed at the start"};
inline constexpr PropertyUse joints_start_at{"joint.position.initial", "of every joint, optional"};
inline constexpr PropertyUse sizes{"collision.shapes", "of the wheels; else visual.shapes"};

}  // namespace muro::wheeled
