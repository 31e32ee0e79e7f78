// SPDX-License-Identifier: MIT
// The model of a robot for a multi-body engine: rigid bodies that joints connect.
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
  std::uint32_t loaded_link = 0;  ///< index in RobotModel::loaded_links; 0 for external bodies
  ObjectId object = no_object;    ///< object that has the shape
};

/// Links that fixed joints hold together: one body, with the joint that moves it. The frame of the body is the frame of
/// its first link, which the joint moves.
struct RigidBody {
  std::uint32_t link = 0;    ///< index in the robot of the body's first link
  std::int32_t parent = -1;  ///< number of the parent body, below its own; -1: this is the base
  JointKind joint = JointKind::fixed;
  Pose origin;                ///< pose of this body in its parent's frame with the joint at 0
  Vec3 axis = Vec3::UnitX();  ///< unit, in this body's frame
  JointLimits limits;         ///< a mimic joint has no position limits: it follows its leader
  DriveMode drive = DriveMode::passive;
  std::int32_t leader = -1;  ///< number of the body whose joint this one mimics
  double multiplier = 1, offset = 0;
  Inertia inertia;  ///< in the body's frame; mass above 0, tensor positive definite
  std::vector<BodyShape> shapes;
};

/// The place of a link in its body.
struct LinkPlacement {
  std::uint32_t body = 0;
  Pose pose;  ///< in the body's frame
};

/// A link on which external wrenches and contacts act: the base, or a link with collision shapes.
struct LoadedLink {
  std::uint32_t link = 0;  ///< index in the robot
  bool has_shapes = false;
  LinkPlacement placement;
  ObjectId object = no_object;
};

struct RobotModel {
  std::string name;
  std::vector<RigidBody> bodies;  ///< the base first, children after their parents
  std::vector<LoadedLink> loaded_links;
  bool fixed_base = false;
  bool self_collision = false;
  double mass = 0;                             ///< kg
  std::vector<std::string> regularized_links;  ///< links whose mass or inertia was raised to make them movable
  std::vector<double> initial_positions;       ///< rad or m, one per body

  /// Whether a joint connects two bodies, which then never collide.
  bool adjacent(std::uint32_t a, std::uint32_t b) const {
    return bodies[a].parent == std::int32_t(b) || bodies[b].parent == std::int32_t(a);
  }
};

/// Lower bounds of inertias for an engine. A body gets at least `mass_fraction` of the robot's mass, and at least the
/// principal moments of a ball of its mass and of `radius` (m).
struct MinInertia {
  double mass_fraction = 1e-6;
  double radius = 1e-3;
  /// Returns the box around a shape, in the axes of its body. When this function is set, every body has at least the
  /// inertia that contacts at the box around its shapes need (missing_inertia).
  std::function<std::optional<Aabb>(const Shape&)> box_of = {};
};

/// Makes the model of a robot. `modes`: mode of every link's joint. Throws Error when the robot has no mass. [setup]
RobotModel model_of(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
                    const MinInertia& min_inertia);

/// Returns the pose of a body in its parent's frame when its joint is at `position` (rad or m).
Pose pose_in_parent(const RigidBody& body, double position);

}  // namespace muro::multibody
