// SPDX-License-Identifier: MIT
// Numbers that a scenario may give to `trot`. The defaults are those of examples/models/quadruped.urdf.
#pragma once

#include <cstddef>

#include "muro_controller.h"

namespace quadruped::tunable {

// A line for each group.
// clang-format off
enum Index : std::size_t {
  forward, left, turn, step_in_place,
  hip_front, hip_rear, hip_side, hip_up, abduction, thigh, shank, foot_radius, bend_front, bend_rear,
  mass, thigh_mass, shank_mass, foot_mass, armature, center_x, center_z, inertia_x, inertia_y, inertia_z,
  gravity, friction, effort_abduction, effort_hip, effort_knee, speed,
  height, wider, period, duty, lift, press, placement_gain, step_most, acceleration, turn_acceleration, climb,
  gain_speed, gain_trim, gain_height, gain_climb, gain_attitude, gain_rotation, gain_heading, gain_turn, gain_place,
  swing_frequency, swing_damping, reach_speed, trust, settling, leaning,
};
// clang-format on

inline constexpr muro_tunable all[] = {
    // commands
    {"forward", "m/s", 0, -3, 3, "command where no command.twist is connected"},
    {"left", "m/s", 0, -2, 2, "the same, to the side"},
    {"turn", "rad/s", 0, -3, 3, "the same, counter-clockwise"},
    {"step_in_place", "1", 0, 0, 1, "1: it trots without a command, too"},
    // dimensions
    {"hip_front", "m", 0.18, -2, 2, "axes of abduction of the front legs, along x of the body"},
    {"hip_rear", "m", -0.18, -2, 2, "of the rear legs"},
    {"hip_side", "m", 0.07, 0, 2, "of the left legs, along y"},
    {"hip_up", "m", 0, -1, 1, "of all legs, along z"},
    {"abduction", "m", 0.06, 0, 1, "from the axis of abduction outwards to the plane of thigh and shank"},
    {"thigh", "m", 0.2, 0.01, 2, "length"},
    {"shank", "m", 0.2, 0.01, 2, "length, to the middle of the foot"},
    {"foot_radius", "m", 0.02, 0, 0.5, "of the ball"},
    {"bend_front", "1", -1, -1, 1, "sign of the angle of the front knees; below 0 they point backwards"},
    {"bend_rear", "1", -1, -1, 1, "the same of the rear knees"},
    // masses
    {"mass", "kg", 12, 0.05, 1000, "of the robot"},
    {"thigh_mass", "kg", 0, 0, 100, "of each; 0: 0.046 of the robot"},
    {"shank_mass", "kg", 0, 0, 100, "of each without its foot; 0: 0.0125 of the robot"},
    {"foot_mass", "kg", 0, 0, 100, "of each; 0: 0.0042 of the robot"},
    {"armature", "kg m^2", 0, 0, 10, "of the drives"},
    {"center_x", "m", 0, -1, 1, "centre of mass of what is no thigh, shank or foot, in the frame of the body"},
    {"center_z", "m", 0, -1, 1, "the same, along z"},
    {"inertia_x", "kg m^2", 0, 0, 1000, "of the standing robot about its centre of mass; 0: by mass and hips"},
    {"inertia_y", "kg m^2", 0, 0, 1000, "the same about y"},
    {"inertia_z", "kg m^2", 0, 0, 1000, "the same about z"},
    // limits
    {"gravity", "m/s^2", 9.81, 0.1, 100, "where it walks"},
    {"friction", "1", 0.6, 0.05, 2, "of the feet on the ground, that it counts on"},
    {"effort_abduction", "N m", 20, 0.01, 1e4, "limit of the joints"},
    {"effort_hip", "N m", 20, 0.01, 1e4, "the same"},
    {"effort_knee", "N m", 20, 0.01, 1e4, "the same"},
    {"speed", "rad/s", 12, 0.1, 100, "limit of the joints of swinging legs"},
    // gait
    {"height", "m", 0, 0, 3, "of the origin of the body above the ground; 0: hips at 0.75 of a straight leg"},
    {"wider", "m", 0, -0.2, 0.3, "by which feet stand farther out than their legs"},
    {"period", "s", 0.4, 0.1, 2, "of a stride"},
    {"duty", "1", 0.5, 0.5, 0.9, "part of the stride in which a foot stands"},
    {"lift", "m", 0.06, 0.005, 0.5, "of a swinging foot above the ground"},
    {"press", "m", 0.01, 0, 0.1, "below the ground, where a swinging foot is sent to"},
    {"placement_gain", "s", 0.06, 0, 0.5, "Raibert's: a foot goes farther out by what the body is too fast"},
    {"step_most", "m", 0, 0, 1, "of a foot from the place below its hip; 0: 0.45 of a straight leg"},
    {"acceleration", "m/s^2", 1, 0.05, 20, "by which it follows commands"},
    {"turn_acceleration", "rad/s^2", 3, 0.05, 50, "the same"},
    {"climb", "m/s", 0.3, 0.01, 2, "of the body when it stands up"},
    // gains
    {"gain_speed", "1/s", 8, 0, 50, "of the body along the ground"},
    {"gain_trim", "1/s", 1, 0, 20, "of what is missing of the speed for long"},
    {"gain_height", "1/s^2", 150, 0, 2000, "of the body's height"},
    {"gain_climb", "1/s", 20, 0, 200, "of its change"},
    {"gain_attitude", "1/s^2", 200, 0, 2000, "of roll and pitch"},
    {"gain_rotation", "1/s", 25, 0, 200, "of their rates"},
    {"gain_heading", "1/s^2", 40, 0, 2000, "of the yaw"},
    {"gain_turn", "1/s", 15, 0, 200, "of its rate"},
    {"gain_place", "1/s^2", 20, 0, 500, "of the place above the feet while it stands"},
    {"swing_frequency", "rad/s", 80, 1, 1000, "of the joints of a swinging leg about what they are sent to"},
    {"swing_damping", "1", 0.7, 0, 10, "damping ratio of the same"},
    {"reach_speed", "m/s", 1.2, 0.01, 5, "of a foot that finds no ground where it should be"},
    {"trust", "1/s", 40, 0.1, 1000, "in the legs that stand rather than in the accelerometer"},
    {"settling", "1/s", 20, 0.1, 1000, "of the height of the ground"},
    {"leaning", "1/s", 12, 0, 1000, "of the slope of the ground"},
};
static_assert(sizeof all / sizeof *all == leaning + 1);

}  // namespace quadruped::tunable
