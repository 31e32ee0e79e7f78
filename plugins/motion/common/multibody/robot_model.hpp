// SPDX-License-Identifier: MIT
// A robot as a multi-body engine takes it: rigid bodies that joints hold together.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "muro/scene.hpp"
#include "muro/shape.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::multibody {

/// A collision shape of a body.
struct BodyShape {
  Shape shape;                    ///< its origin in the frame of the body
  std::uint32_t loaded_link = 0;  ///< in RobotModel::loaded_links; 0 for bodies that are not of the world
  ObjectId object = no_object;    ///< that has the shape
};

/// Links that fixed joints hold together, as one body with the joint that moves it. Its frame is that of its first
/// link, the one behind the joint.
struct RigidBody {
  std::uint32_t link = 0;    ///< of the robot: the first of its links
  std::int32_t parent = -1;  ///< body, smaller than its own number; -1: this is the base
  JointKind joint = JointKind::fixed;
  Pose origin;                ///< of this body in its parent's frame with the joint at 0
  Vec3 axis = Vec3::UnitX();  ///< unit, in this body's frame
  JointLimits limits;         ///< of a mimic joint, none of position: it goes where its leader takes it
  DriveMode drive = DriveMode::passive;
  std::int32_t leader = -1;  ///< body whose joint this one mimics
  double multiplier = 1, offset = 0;
  Inertia inertia;  ///< in the body's frame; mass above 0, tensor positive definite
  std::vector<BodyShape> shapes;
};

/// Where a link is fixed in a body.
struct LinkPlacement {
  std::uint32_t body = 0;
  Pose pose;  ///< in the body's frame
};

/// A link on which external wrenches and contacts act: the base, or one with collision shapes.
struct LoadedLink {
  std::uint32_t link = 0;  ///< of the robot
  bool has_shapes = false;
  LinkPlacement placement;
  ObjectId object = no_object;
};

struct RobotModel {
  std::string name;
  std::vector<RigidBody> bodies;  ///< the base first, children behind their parents
  std::vector<LoadedLink> loaded_links;
  bool fixed_base = false;
  bool self_collision = false;
  double mass = 0;                             ///< kg
  std::vector<std::string> regularized_links;  ///< whose mass or inertia was raised, since no engine can move it
  std::vector<double> initial_positions;       ///< rad or m, one per body

  /// Whether a joint connects two bodies, which then never collide.
  bool adjacent(std::uint32_t a, std::uint32_t b) const {
    return bodies[a].parent == std::int32_t(b) || bodies[b].parent == std::int32_t(a);
  }
};

/// What an engine needs of inertias: bodies with less than `mass_fraction` of the robot's mass, or with a principal
/// moment below that of a ball of `radius` (m) of their mass, get that much.
struct MinInertia {
  double mass_fraction = 1e-6;
  double radius = 1e-3;
  /// The box around a shape, in the axes of its body. Where this is there, no body has less inertia than contacts at
  /// the box around its shapes need (missing_inertia).
  std::function<std::optional<Aabb>(const Shape&)> box_of = {};
};

/// `modes`: of every link's joint. Throws Error when the robot has no mass. [setup]
RobotModel model_of(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
                    const MinInertia& min_inertia);

/// The pose of a body in its parent's frame when its joint is at `position` (rad or m).
Pose pose_in_parent(const RigidBody& body, double position);

}  // namespace muro::multibody
