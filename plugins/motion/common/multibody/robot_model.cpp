// SPDX-License-Identifier: MIT
#include "robot_model.hpp"

#include <Eigen/Eigenvalues>

#include "consistent_inertia.hpp"
#include "missing_inertia.hpp"
#include "muro/base/bounds.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::multibody {

namespace {

/// Raises `inertia` to at least `mass` and the principal moments of a ball of `radius`, and makes it physically
/// consistent. Returns whether it was changed.
bool regularize(Inertia& inertia, double mass, double radius) {
  bool changed = false;
  if (!(inertia.mass >= mass)) {
    inertia.mass = mass;
    changed = true;
  }
  const double moment = 0.4 * inertia.mass * radius * radius;
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia.tensor());
  if (!principal.eigenvalues().allFinite() || principal.eigenvalues().minCoeff() < moment) {
    Vec3 moments = Vec3::Constant(moment);
    Mat3 axes = Mat3::Identity();
    if (principal.eigenvalues().allFinite()) {
      moments = principal.eigenvalues().cwiseMax(moment);
      axes = principal.eigenvectors();
    }
    inertia = Inertia::from(inertia.mass, inertia.com, axes * moments.asDiagonal() * axes.transpose());
    changed = true;
  }
  const std::optional<Inertia> consistent = nearest_consistent_inertia(inertia);
  if (consistent) inertia = *consistent;
  return changed || consistent;
}

/// Returns the mass (kg) whose weight at the centre of mass of a body uses a fiftieth of the effort limits of the
/// joints between it and the base, at their start positions. `frames`: frames of the bodies in the frame of the base.
double bearable_mass(const RobotModel& model, std::size_t number, std::span<const Pose> frames) {
  constexpr double part = 0.02, gravity = 9.81;
  const Vec3 com = frames[number] * model.bodies[number].inertia.com;
  double mass = std::numeric_limits<double>::infinity();
  for (std::size_t i = number; model.bodies[i].parent >= 0; i = std::size_t(model.bodies[i].parent)) {
    const RigidBody& body = model.bodies[i];
    const Vec3 axis = frames[i].orientation * body.axis, arm = com - frames[i].position;
    const double lever = body.joint == JointKind::revolute ? axis.cross(arm).norm() : 1;
    if (body.limits.effort > 0 && lever > 0) mass = std::min(mass, part * body.limits.effort / (gravity * lever));
  }
  return mass;
}

/// Raises the least inertia of a body that touches others, because it carries part of the robot. If it has only the
/// least mass of the engine, iterative engines need too many iterations, and soft contacts give way without end. A body
/// without mass becomes a ball about its shapes with a thousandth of the robot's mass. A body with mass becomes at
/// least such a ball with a share that contacts of all engines hold (a leg sinks in when its share is 1e-5 or less). No
/// more is added than the joints that carry the body can hold.
MinInertia least_inertia_of(const RobotModel& model, std::size_t number, std::span<const Pose> frames,
                            const MinInertia& of_engine) {
  constexpr double share_without_mass = 1e-3, least_share = 5e-5;
  const RigidBody& body = model.bodies[number];
  const double mass = body.inertia.mass;
  if (body.shapes.empty() || mass >= least_share * model.mass) return of_engine;
  double radius = of_engine.radius;
  for (const BodyShape& s : body.shapes)
    if (s.shape.kind != ShapeKind::plane) radius = std::max(radius, half_extents(s.shape).maxCoeff());
  const double share = mass > 0 ? least_share : share_without_mass,
               borne = (mass + bearable_mass(model, number, frames)) / model.mass;
  if (mass > 0 && borne < share)
    return of_engine.mass_fraction < borne ? MinInertia{borne, of_engine.radius} : of_engine;
  return {std::max(share, of_engine.mass_fraction), radius};
}

/// Adds the inertia that contacts need. Returns whether some was missing.
bool complete_inertia(RigidBody& body, const MinInertia& min_inertia) {
  if (!min_inertia.box_of) return false;
  Aabb box;
  for (const BodyShape& s : body.shapes)
    if (const std::optional<Aabb> around = min_inertia.box_of(s.shape)) box.include(*around);
  if (!(body.inertia.mass > 0) || !((box.high - box.low).minCoeff() > 0)) return false;
  const std::optional<Mat3> missing = missing_inertia(body.inertia, box);
  if (missing) body.inertia = Inertia::from(body.inertia.mass, body.inertia.com, body.inertia.tensor() + *missing);
  return missing.has_value();
}

RigidBody body_of(const Link& link, std::uint32_t number, DriveMode mode) {
  RigidBody body;
  body.link = number;
  body.joint = link.joint;
  body.axis = link.axis;
  body.limits = link.limits;
  body.drive = mode;
  return body;
}

/// Finds the bodies. Returns the placement of each link in its body.
std::vector<LinkPlacement> add_bodies(RobotModel& model, const RobotView& robot, std::span<const DriveMode> modes,
                                      std::span<const double> initial_positions) {
  std::vector<LinkPlacement> placements(robot.links.size());
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    LinkPlacement& placement = placements[i];
    if (i > 0 && link.joint == JointKind::fixed) {
      placement = placements[std::size_t(link.parent)];
      placement.pose = placement.pose * link.origin;
      continue;
    }
    placement.body = std::uint32_t(model.bodies.size());
    RigidBody body = body_of(link, std::uint32_t(i), modes[i]);
    if (i > 0) {
      const LinkPlacement& parent = placements[std::size_t(link.parent)];
      body.parent = std::int32_t(parent.body);
      body.origin = parent.pose * link.origin;
    }
    model.bodies.push_back(std::move(body));
    model.initial_positions.push_back(initial_positions[i]);
  }
  return placements;
}

}  // namespace

Pose pose_in_parent(const RigidBody& body, double position) {
  Link link;
  link.joint = body.joint;
  link.origin = body.origin;
  link.axis = body.axis;
  return muro::pose_in_parent(link, position);
}

RobotModel model_of(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
                    const MinInertia& min_inertia) {
  const std::vector<Inertia> inertias = inertias_of(connector, robot);
  RobotModel model;
  model.name = robot.name;
  for (const Inertia& i : inertias) model.mass += i.mass;
  if (!(model.mass > 0) || !std::isfinite(model.mass))
    throw Error(quote(model.name) +
                " has no mass; give its bodies mass and inertia (`inertial`), fix its base (`base: fixed`), where its "
                "joints need no forces, or move it with motion.point");
  const std::vector<LinkPlacement> placements =
      add_bodies(model, robot, modes, initial_joint_positions(connector, robot));
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const LinkPlacement& placement = placements[i];
    RigidBody& body = model.bodies[placement.body];
    body.inertia = body.inertia + inertias[i].in(placement.pose);
    const auto shapes = connector.constant_array(robot.links[i].object, keys::collision_shapes);
    for (const Shape& s : shapes) {
      body.shapes.push_back({s, std::uint32_t(model.loaded_links.size()), robot.links[i].object});
      body.shapes.back().shape.origin = placement.pose * s.origin;
    }
    if (i == 0 || !shapes.empty())
      model.loaded_links.push_back({std::uint32_t(i), !shapes.empty(), placement, robot.links[i].object});
  }
  std::vector<Pose> frames(model.bodies.size());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    RigidBody& body = model.bodies[i];
    if (i > 0) frames[i] = frames[std::size_t(body.parent)] * pose_in_parent(body, model.initial_positions[i]);
    const Link& link = robot.links[body.link];
    if (link.mimic >= 0) {
      body.leader = std::int32_t(placements[std::size_t(link.mimic)].body);
      body.multiplier = link.mimic_multiplier;
      body.offset = link.mimic_offset;
      body.limits.lower = -std::numeric_limits<double>::infinity();
      body.limits.upper = std::numeric_limits<double>::infinity();
    }
    const MinInertia least = least_inertia_of(model, i, frames, min_inertia);
    const bool is_completed = complete_inertia(body, min_inertia);
    if (regularize(body.inertia, least.mass_fraction * model.mass, least.radius) || is_completed)
      model.regularized_links.emplace_back(connector.object_name(link.object));
  }
  return model;
}

}  // namespace muro::multibody
