// SPDX-License-Identifier: MIT
#include "host/outputs/free_camera.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "host/scenario/shadows.hpp"
#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr double least_radius = 1.5;  ///< m, least radius of the view
constexpr double moved = 0.1;         ///< m: a robot that is nearer to its start has not moved
constexpr double clearance = 0.1;     ///< of the line of sight above the ground, relative to the radius of the view
constexpr double slowness = 0.5;      ///< s, in which the camera covers most of its distance to the team

/// Returns the pose of a camera at `from` that looks at `to`, without roll.
Pose looking(const Vec3& from, const Vec3& to) {
  const Vec3 forward = to - from;
  const double yaw = elementary::atan2(forward.y(), forward.x());
  return {from, from_rpy(0, -elementary::atan2(forward.z(), forward.head<2>().norm()), yaw)};
}

/// Radius (m) of a ball about the base that holds the robot's visible shapes in any joint position; meshes are points.
double radius_of(const World& world, const RobotView& robot) {
  std::vector<double> reach(robot.links.size());
  double radius = 0;
  for (std::size_t i = 0; i < reach.size(); ++i) {
    const Link& link = robot.links[i];
    if (i > 0) reach[i] = reach[std::size_t(link.parent)] + link.origin.position.norm();
    radius = std::max(radius, reach[i]);
    for (const Shape& s : world.constants(link.object, keys::visual_shapes))
      if (s.kind != ShapeKind::plane)
        radius = std::max(radius, reach[i] + s.origin.position.norm() + half_extents(s).norm());
  }
  return std::min(radius, 100.0);
}

}  // namespace

FreeCamera::FreeCamera(Simulation& simulation, const char* name, const std::optional<Vec3>& given_from,
                       const std::optional<Vec3>& given_to)
    : simulation_(&simulation), given_from_(given_from), given_to_(given_to) {
  World& world = simulation.world();
  if (!given_from) {
    hills_ = std::make_shared<Hills>(simulation);
    hills_->ground.add_scenery(world);
    if (!hills_->ground.has_heightmaps()) hills_.reset();
  }
  for (const RobotView* r : world.robots())
    if (!is_shadow(simulation, *r))
      team_.push_back(
          {r->base(), world.constant(r->base(), keys::initial_pose, Pose{}).position, radius_of(world, *r)});
  object_ = world.add_object(name);
  aim(1);
  if (distance() < 1e-9) throw SetupError("--from and --to are the same point; the picture needs a direction");
  const Pose pose = looking(from(), target_);
  PropertyStore& store = world.store();
  pose_ = static_cast<Pose*>(
      store.bind(store.add_accessor(name), object_, keys::pose, usage::derived, Multiplicity::single, 1, &pose));
}

void FreeCamera::look(double dt) {
  aim(std::isfinite(dt) ? 1 - elementary::exp(-dt / slowness) : 1);
  if (distance() > 1e-9) *pose_ = looking(from(), target_);
}

Vec3 FreeCamera::from() const {
  if (given_from_) return *given_from_;
  Vec3 from = target_ + 1.7 * radius_ * Vec3(-0.75, -0.75, 0.7);
  if (!hills_) return from;
  // a ball rolls over the hills along the line of sight, up to the robots, and the line is raised until it is clear
  const StandingShape ball{Shape::sphere(clearance * radius_), "", {}};
  double height = from.z();
  constexpr int parts = 24;  // so the distance of two points is less than the ball's width
  for (int i = parts; i >= parts / 3; --i) {
    const double part = double(i) / parts;
    const auto ground =
        hills_->ground.height_on_terrain({&ball, 1}, {target_ + part * (from - target_), Quat::Identity()});
    if (ground) height = std::max(height, target_.z() + (*ground - target_.z()) / part);
  }
  from.z() = height;
  return from;
}

/// Moves the target this part of the way to the team's present place; before the simulation is built, to its start.
void FreeCamera::aim(double part) {
  const World& world = simulation_->world();
  Aabb of_all, of_moving;
  for (const Member& m : team_) {
    const Vec3 at = pose_ ? world.value(m.base, keys::pose).position : m.start, reach = Vec3::Constant(m.radius);
    if (!(at.cwiseAbs().maxCoeff() < 1e6)) continue;
    const bool moves = (at - m.start).norm() > moved;
    for (Aabb* box : {&of_all, &of_moving})
      if (box == &of_all || moves) box->include({at - reach, at + reach});
  }
  const bool any_moves = (of_moving.high - of_moving.low).minCoeff() >= 0;
  Aabb box = any_moves ? of_moving : of_all;
  if (!((box.high - box.low).minCoeff() >= 0)) box = {Vec3::Zero(), Vec3::Zero()};
  const Vec3 middle = given_to_.value_or(0.5 * (box.low + box.high));
  target_ += part * (middle - target_);
  radius_ += part * (std::max(least_radius, 0.5 * (box.high - box.low).norm()) - radius_);
}

}  // namespace muro::host
