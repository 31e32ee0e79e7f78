// SPDX-License-Identifier: MIT
// Solid parts of a robot, as the tests compute them: shapes by link, and the height of their lowest point.
#pragma once

#include <span>

#include "core/robot_tree.hpp"
#include "muro/shape.hpp"

namespace muro::robots {

/// A collision shape of a robot.
struct Solid {
  std::size_t link = 0;        ///< of the robot
  Shape shape;                 ///< its origin in the frame of the link
  std::vector<Vec3> vertices;  ///< of a mesh, m, in the frame of the shape
};

/// Returns all collision shapes of a model. Leaves out meshes whose file `vertices_of` cannot read.
std::vector<Solid> solids_of(const RobotTree& tree);

/// Returns the corners of the mesh in a file: text STL, OBJ, or COLLADA with one geometry in metres and z up. Empty for
/// other files.
std::vector<Vec3> vertices_of(const std::string& path);

/// Returns the height (m) of the lowest point of all shapes, from the poses of the links; infinite without shapes.
double lowest_point(std::span<const Solid> solids, std::span<const Pose> poses, bool with_meshes);

/// Returns positions (rad or m) of all joints, one per link, as near to 0 as their limits allow. Mimic joints follow
/// their leader.
std::vector<double> start_positions(const RobotTree& tree);
/// Returns the poses of all links, with the base at `base` and joints at `positions`.
std::vector<Pose> poses_of(const RobotTree& tree, const Pose& base, std::span<const double> positions);

}  // namespace muro::robots
