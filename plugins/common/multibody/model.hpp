// SPDX-License-Identifier: MIT
// A robot as a multi-body engine wants it: rigid parts that joints hold together.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "muro/shape.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::multibody {

/// A shape of a part.
struct PartShape {
  Shape shape;             ///< its origin in the part's frame
  std::uint32_t body = 0;  ///< in RobotModel::bodies; 0 for fixtures
};

/// Frames that fixed joints hold together, as one rigid body. Its frame is that of its first link, the one that the
/// joint moves.
struct Part {
  std::uint32_t frame = 0;   ///< of the robot: the first of its frames
  std::int32_t parent = -1;  ///< part, smaller than its own number; -1: the base
  JointKind joint = JointKind::fixed;
  Pose origin;                ///< of this part in its parent's with the joint at 0
  Vec3 axis = Vec3::UnitX();  ///< unit, in this part's frame
  JointLimits limits;
  DriveMode drive = DriveMode::passive;
  std::int32_t leader = -1;  ///< part whose joint this one mimics
  double multiplier = 1, offset = 0;
  Inertia inertia;  ///< in the part's frame; mass above 0, tensor positive definite
  std::vector<PartShape> shapes;
};

/// A frame of a robot at rest in one of its parts.
struct Place {
  std::uint32_t part = 0;
  Pose pose;  ///< in the part's frame
};

/// A link at which forces act from outside: the base, or one with collision shapes.
struct TouchedBody {
  std::uint32_t frame = 0;  ///< of the robot
  bool shaped = false;
  Place place;
};

struct RobotModel {
  std::string name;
  std::vector<Part> parts;  ///< the base first, children behind their parents
  std::vector<TouchedBody> bodies;
  bool fixed_base = false;
  bool self_collision = false;
  double mass = 0;                      ///< kg
  std::vector<std::string> mended;      ///< links whose mass or inertia no engine can move, and was made larger
  std::vector<double> start_positions;  ///< rad or m, one a part

  /// Whether two parts never touch: joined by a joint, or both held by it.
  bool adjacent(std::uint32_t a, std::uint32_t b) const {
    return parts[a].parent == std::int32_t(b) || parts[b].parent == std::int32_t(a);
  }
};

/// What an engine needs of inertias: parts lighter than `least_mass` times the robot, or with a principal moment less
/// than that of a ball of `least_radius` (m) of their mass, get that much.
struct InertiaFloor {
  double least_mass = 1e-6;
  double least_radius = 1e-3;
};

/// `modes`: of every frame's joint. Throws Error when the robot has no mass. [setup]
RobotModel model_of(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
                    const InertiaFloor& floor);

/// The pose of a part in its parent's when its joint is at `position` (rad or m).
Pose placed(const Part& part, double position);

}  // namespace muro::multibody
