// SPDX-License-Identifier: MIT
#include "forced_joints.hpp"

#include <string>

namespace muro::simplified {

namespace {

std::vector<std::uint32_t> frames_of_dofs(const RobotView& robot, std::span<const Place> places) {
  std::vector<std::uint32_t> frames;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (places[i].forced && robot.links[i].mimic < 0) frames.push_back(i);
  return frames;
}

}  // namespace

ForcedJoints::ForcedJoints(Connector& c, const RobotView& robot, std::span<const Place> places,
                           std::span<const Inertia> inertias, std::span<const double> start, const Settings& settings)
    : settings_(settings),
      linkage_(robot.links, inertias, frames_of_dofs(robot, places), settings.fixed_base),
      positions_(start.begin(), start.end()) {
  linkage_.update({}, {}, positions_, Vec3::Zero());
  for (const Linkage::Dof& dof : linkage_.dofs()) {
    const Link& f = robot.links[dof.frame];
    const double inertia = dof.inertia + settings.armature;
    if (!(inertia > 1e-12))
      throw Error("joint `" + std::string(c.object_name(f.joint_object)) + "` moves an inertia of " +
                  std::to_string(inertia) +
                  " kg m^2 or kg, so no force can move it; give the bodies behind it mass and inertia (`inertial`), or "
                  "set `armature`");
    Joint j{places[dof.frame], f.limits, 1e-3 * inertia, c.derived(f.joint_object, keys::joint_effort), {}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Link& other = robot.links[i];
      if (other.mimic != std::int32_t(dof.frame)) continue;
      j.followers.push_back({places[i].position, places[i].velocity, other.mimic_multiplier, other.mimic_offset});
      j.limits.damping += other.mimic_multiplier * other.mimic_multiplier * other.limits.damping;
      j.limits.friction += std::abs(other.mimic_multiplier) * other.limits.friction;
    }
    joints_.push_back(std::move(j));
  }
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const ObjectId body = robot.links[i].object;
    if (places[i].position) turns_.push_back({places[i].position, places[i].velocity, i});
    if (i == 0 || !c.constant_array(body, keys::collision_shapes).empty())
      linkage_.add_touch(i, c.read_sum(body, keys::external_wrench));
  }
}

Wrench ForcedJoints::look(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt) {
  for (const Turn& t : turns_) positions_[t.frame] = *t.position + *t.velocity * (0.5 * dt);
  return linkage_.update(pose, twist, positions_, gravity);
}

bool ForcedJoints::move(double dt) {
  double all = 0;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& j = joints_[k];
    const Linkage::Dof& dof = linkage_.dofs()[k];
    const double inertia = std::max(dof.inertia + settings_.armature, j.least_inertia);
    DofState state{*j.place.position, *j.place.velocity};
    if (j.place.mode == DriveMode::effort || j.place.mode == DriveMode::passive) {
      *j.effort = j.place.target ? std::clamp(*j.place.target, -j.limits.effort, j.limits.effort) : 0;
      state = pushed(state, *j.effort + dof.force, inertia, j.limits, dt);
    } else {
      const Drive drive{kernel_mode(j.place.mode), *j.place.target, settings_.acceleration};
      state = driven(state, drive, dof.force, inertia, j.limits, dt, *j.effort);
    }
    *j.place.position = state.position;
    *j.place.velocity = state.velocity;
    for (const Follower& f : j.followers) {
      *f.position = f.offset + f.multiplier * state.position;
      *f.velocity = f.multiplier * state.velocity;
    }
    all += state.position + state.velocity;
  }
  return std::isfinite(all);
}

}  // namespace muro::simplified
