// SPDX-License-Identifier: MIT
#include "force_driven_joints.hpp"
#include "muro/base/number_text.hpp"

#include <algorithm>
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
                                     std::span<const PositionDrive> drives, std::string_view memory,
                                     const Settings& settings)
    : settings_(settings),
      dynamics_(robot.links, inertias, links_of_dofs(robot, properties), settings.fixed_base, settings.armature),
      positions_(start.begin(), start.end()) {
  dynamics_.update({}, {}, positions_, Vec3::Zero());
  for (const DecoupledDynamics::Dof& dof : dynamics_.dofs()) {
    const Link& link = robot.links[dof.link];
    const double armature = settings.armature + link.limits.armature, inertia = dof.inertia + armature;
    if (!(inertia > least_dof_inertia))
      throw Error("joint `" + std::string(c.object_name(link.joint_object)) + "` moves an inertia of " +
                  number_text(inertia) +
                  " kg m^2 or kg, so no force can move it; give the bodies behind it mass and inertia (`inertial`), or "
                  "set `armature`");
    Joint j;
    j.properties = properties[dof.link];
    j.limits = link.limits;
    j.min_inertia = 1e-3 * inertia;
    j.object = link.joint_object;
    j.effort = c.derived(link.joint_object, keys::joint_effort);
    if (j.properties.has_position_drive) {
      has_position_drives_ = true;
      j.drive = drives[dof.link];
      j.target = PositionTarget(link.joint_object, j.properties.target, j.drive.interpolation);
    }
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const Link& other = robot.links[i];
      if (other.mimic != std::int32_t(dof.link)) continue;
      j.followers.push_back(
          {properties[i].position, properties[i].velocity, other.mimic_multiplier, other.mimic_offset});
      j.limits.damping += other.mimic_multiplier * other.mimic_multiplier * other.limits.damping;
      j.limits.friction += std::abs(other.mimic_multiplier) * other.limits.friction;
      j.limits.armature += other.mimic_multiplier * other.mimic_multiplier * other.limits.armature;
    }
    joints_.push_back(std::move(j));
  }
  for (std::uint32_t i = 0; i < properties.size(); ++i) {
    const ObjectId body = robot.links[i].object;
    if (properties[i].position) link_joints_.push_back({properties[i].position, properties[i].velocity, i});
    if (i == 0 ? settings.feels_wrench
               : settings.feels_contact && !c.constant_array(body, keys::collision_shapes).empty())
      dynamics_.add_wrench(i, c.read_sum(body, keys::external_wrench));
  }
  if (!has_position_drives_) return;
  std::size_t count = 0;
  for (const Joint& j : joints_) count += j.target.memory_size();
  if (count == 0) return;
  auto* next = static_cast<double*>(c.state_block(robot.base(), memory, std::uint32_t(count * sizeof(double))));
  for (Joint& j : joints_) {
    if (j.target.memory_size() > 0) j.target.keep_in({next, j.target.memory_size()});
    next += j.target.memory_size();
  }
}

void ForceDrivenJoints::connect_by_name(Connector& c) {
  for (Joint& j : joints_) {
    if (j.properties.has_position_drive) j.target.connect_by_name(c);
    if (j.properties.mode == DriveMode::effort) j.losses.connect_by_name(c, j.object);
  }
}

void ForceDrivenJoints::take_over() const {
  for (const Joint& j : joints_) j.target.take_over();
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
    const double inertia = std::max(dof.inertia + settings_.armature + j.limits.armature, j.min_inertia);
    DofState state{*j.properties.position, *j.properties.velocity};
    if (j.properties.mode == DriveMode::effort || j.properties.mode == DriveMode::passive) {
      *j.effort = j.properties.target ? std::clamp(*j.properties.target, -j.limits.effort, j.limits.effort) : 0;
      JointLimits limits = j.limits;
      limits.friction += j.losses.friction();
      state = integrate_effort(state, *j.effort, dof.force, inertia + j.losses.armature(), limits, dt);
    } else if (j.properties.has_position_drive) {
      const Reference reference = j.target.advance(state.position, j.limits, dt);
      const PdGains gains = j.drive.gains(dynamics_.driven(k));
      const ImplicitDrive drive = implicit_drive(gains, reference.position - state.position, reference.velocity, dt);
      state = follow_drive(state, drive, dof.force, inertia, j.limits, dt, *j.effort);
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
