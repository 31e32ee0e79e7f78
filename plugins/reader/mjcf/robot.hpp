// SPDX-License-Identifier: MIT
#pragma once

#include "bodies.hpp"
#include "drives.hpp"
#include "muro/robot_builder.hpp"
#include "shapes.hpp"

namespace muro::mjcf {

/// What robots of one file are made from.
struct RobotSource {
  const mjModel& model;
  const Source& source;
  const Drives& drives;
  bool in_world;  ///< the file is read as a world
};

/// The pose of a robot's base in the world: that of its first body, or of the world where joints hold that.
Pose base_pose(const mjModel& m, int top);

/// Builds the tree of bodies under `top`, a body right under the world's.
void build_robot(const RobotSource& from, int top, Shapes& shapes, RobotBuilder& builder, Problems& problems);

}  // namespace muro::mjcf
