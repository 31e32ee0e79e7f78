// SPDX-License-Identifier: MIT
#include "force_driven_joints.hpp"

#include <string>

namespace muro::simplified {

namespace {

std::vector<std::uint32_t> links_of_dofs(const RobotView& robot, std::span<const JointProperties> properties) {
  std::vector<std::uint32_t> links;
  for (std::uint32_t i = 0; i < properties.size(); ++i)
    if (properties[i].force_driven && robot.links[i].mimic < 0) links.push_back(i);
  return links;
}

}  // namespace

ForceDrivenJoints::ForceDrivenJoints(Connector& c, const RobotView& robot, std::span<const JointProperties> properties,
                                     std::span<const Inertia> inertias, std::span<const double> start,
                                     const Settings& settings)
    : settings_(settings),
      dynamics_(robot.links, inertias, links_of_dofs(robot, properties), settings.fixed_base),
      positions_(start.begin(), start.end()) {
  dynamics_.update({}, {}, positions_, Vec3::Zero());
  for (const DecoupledDynamics::Dof& dof : dynamics_.dofs()) {
    const Link& link = robot.links[dof.link];
    const double inertia = dof.inertia + settings.armature;
    if (!(inertia > 1e-12))
      throw Error("joint `" + std::string(c.object_name(link.joint_object)) + "` moves an inertia of " +
                  std::to_string(inertia) +
                  " kg m^2 or kg, so no force can move it; give the bodies behind it mass and inertia (`inertial`), or "
                  "set `armature`");
    Joint j{properties[dof.link], link.limits, 1e-3 * inertia, c.derived(link.joint_object, keys::joint_effort), {}};
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const Link& other = robot.links[i];
      if (other.mimic != std::int32_t(dof.link)) continue;
      j.followers.push_back(
          {properties[i].position, properties[i].velocity, other.mimic_multiplier, other.mimic_offset});
      j.limits.damping += other.mimic_multiplier * other.mimic_multiplier * other.limits.damping;
      j.limits.friction += std::abs(other.mimic_multiplier) * other.limits.friction;
    }
    joints_.push_back(std::move(j));
  }
  for (std::uint32_t i = 0; i < properties.size(); ++i) {
    const ObjectId body = robot.links[i].object;
    if (properties[i].position) link_joints_.push_back({properties[i].position, properties[i].velocity, i});
    if (i == 0 || !c.constant_array(body, keys::collision_shapes).empty())
      dynamics_.add_wrench(i, c.read_sum(body, keys::external_wrench));
  }
}

Wrench ForceDrivenJoints::evaluate(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt) {
  for (const LinkJoint& j : link_joints_) positions_[j.link] = *j.position + *j.velocity * (0.5 * dt);
  return dynamics_.update(pose, twist, positions_, gravity);
}

bool ForceDrivenJoints::move(double dt) {
  double all = 0;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& j = joints_[k];
    const DecoupledDynamics::Dof& dof = dynamics_.dofs()[k];
    const double inertia = std::max(dof.inertia + settings_.armature, j.min_inertia);
    DofState state{*j.properties.position, *j.properties.velocity};
    if (j.properties.mode == DriveMode::effort || j.properties.mode == DriveMode::passive) {
      *j.effort = j.properties.target ? std::clamp(*j.properties.target, -j.limits.effort, j.limits.effort) : 0;
      state = integrate_force(state, *j.effort + dof.force, inertia, j.limits, dt);
    } else {
      const Drive drive{kernel_mode(j.properties.mode), *j.properties.target, settings_.max_acceleration};
      state = follow_target(state, drive, dof.force, inertia, j.limits, dt, *j.effort);
    }
    *j.properties.position = state.position;
    *j.properties.velocity = state.velocity;
    for (const Follower& f : j.followers) {
      *f.position = f.offset + f.multiplier * state.position;
      *f.velocity = f.multiplier * state.velocity;
    }
    all += state.position + state.velocity;
  }
  return std::isfinite(all);
}

}  // namespace muro::simplified
