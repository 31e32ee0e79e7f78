// SPDX-License-Identifier: MIT
// State of the stance that the motion keeps: properties of the base of the robot.
#pragma once

#include "muro/vocabulary.hpp"

namespace muro::biped::own {

inline constexpr Key<std::uint32_t> stance_foot{"stance.foot", "1", "which of the feet stands, from 0"};
inline constexpr Key<Pose> stance_pose{"stance.pose", "m",
                                       "of the link of the stance foot in the world, while it stands"};
inline constexpr Key<std::uint32_t> stance_is_flush{
    "stance.is_flush", "1", "1: the sole of the stance foot lies on the plane; 0: it is tilted"};
/// While this number is the same, `stance.pose` has the same bits.
inline constexpr Key<std::uint64_t> stance_footholds{"stance.footholds", "1", "how often a foot has been put down"};
/// A base at any other pose means that something else has moved the robot.
inline constexpr Key<Pose> stance_base_pose{"stance.base_pose", "m", "pose of the base as the motion has left it"};

}  // namespace muro::biped::own
