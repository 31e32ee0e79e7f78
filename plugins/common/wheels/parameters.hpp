// SPDX-License-Identifier: MIT
// Parameters that motions and drives of wheeled vehicles share.
#pragma once

#include "muro/algorithm.hpp"
#include "velocity_ramp.hpp"

namespace muro::wheels {

// Choice of the wheels of a vehicle.
inline constexpr Parameter left_wheels = texts("left", "joints of the left wheels; default: as the model has them");
inline constexpr Parameter right_wheels = texts("right", "joints of the right wheels; default: as the model has them");
inline constexpr Parameter all_wheels = texts("wheels", "joints of the wheels; default: as the model has them");
inline constexpr Parameter steering_joints =
    texts("steering", "joints that steer wheels; default: as the model has them");
inline constexpr Parameter driven_wheels =
    texts("driven", "joints of driven wheels; default: all that are not steered");
inline constexpr Parameter rolling_wheels =
    texts("rolling", "joints of wheels that the ground turns; default: all others that the model has");

// Properties of the wheels.
inline constexpr Parameter wheel_radius =
    real("wheel_radius", "m", 0, "of every wheel; 0: of the wheels' shapes").between(0, 1e3);
inline constexpr Parameter track =
    real("track", "m", 0, "between the left and the right wheels; 0: between their centres in the model")
        .between(0, 1e3);
inline constexpr Parameter roller_angle =
    reals("roller_angle", "rad", {},
          "from a wheel's rolling direction to the axis of the roller on the ground: one for all, or one a wheel; "
          "default: mecanum (pi/4) or omni wheels (0), as they stand");

/// Largest command, rad/s or m/s: a larger one is a mistake.
inline constexpr double fastest = 1e12;

// Limits of the wheels.
inline constexpr Parameter max_wheel_speed =
    real("max_wheel_speed", "rad/s", unlimited, "of every driven wheel; the limit of its joint holds as well")
        .between(1e-6, unlimited);
inline constexpr Parameter max_wheel_acceleration =
    real("max_wheel_acceleration", "rad/s^2", unlimited, "of every driven wheel; 1e9: none, the speed jumps")
        .between(1e-6, unlimited);

}  // namespace muro::wheels
