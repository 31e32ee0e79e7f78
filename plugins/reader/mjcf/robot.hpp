// SPDX-License-Identifier: MIT
#pragma once

#include "bodies.hpp"
#include "drives.hpp"
#include "muro/robot_builder.hpp"
#include "shapes.hpp"

namespace muro::mjcf {

/// Common source of the robots of one file.
struct RobotSource {
  const mjModel& model;
  const Source& source;
  const Drives& drives;
  bool in_world;  ///< the file is read as a world
};

/// Returns the pose of a robot's base in the world. The base is the first body, or the world if joints hold that body.
Pose base_pose(const mjModel& m, int top);

/// Builds the tree of bodies with the root `top`, a child of the world's body.
void build_robot(const RobotSource& from, int top, Shapes& shapes, RobotBuilder& builder, Problems& problems);

}  // namespace muro::mjcf
