// SPDX-License-Identifier: MIT
// What of a robot is solid, as the tests see it: shapes by link, and how low they reach.
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

/// All collision shapes of a model. Meshes whose file `vertices_of` does not understand are left out.
std::vector<Solid> solids_of(const RobotTree& tree);

/// Corners of the mesh in a file: text STL, OBJ, or COLLADA of one geometry in metres with z up. Empty when it is
/// nothing of these.
std::vector<Vec3> vertices_of(const std::string& path);

/// Height (m) of the lowest point of all shapes, by the poses of the links in the world; infinite without shapes.
double lowest_point(std::span<const Solid> solids, std::span<const Pose> poses, bool with_meshes);

/// Positions (rad or m) of all joints, one per link, as near to 0 as their limits allow; mimic joints after their
/// leader.
std::vector<double> start_positions(const RobotTree& tree);
/// Poses of all links, the base at `base`, joints at `positions`.
std::vector<Pose> poses_of(const RobotTree& tree, const Pose& base, std::span<const double> positions);

}  // namespace muro::robots
