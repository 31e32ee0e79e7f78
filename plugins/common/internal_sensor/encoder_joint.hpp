// SPDX-License-Identifier: MIT
#pragma once

#include "muro/key.hpp"
#include "muro/robot.hpp"

namespace muro::internal_sensor {

/// Constant on the object of an encoder: the unit of its readings, "rad or m", is that of this joint.
inline constexpr Key<ObjectId> key_encoder_joint{
    "encoder.joint", "1", "the joint that it looks at; of several the first, where all turn or all shift"};

}  // namespace muro::internal_sensor
