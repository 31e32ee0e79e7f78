// SPDX-License-Identifier: MIT
#include "decoupled_dynamics.hpp"

#include <Eigen/LU>

#include "composite_body.hpp"
#include "muro/toolkit/link_pose.hpp"

namespace muro::simplified {

DecoupledDynamics::DecoupledDynamics(std::span<const Link> links, std::span<const Inertia> inertias,
                                     std::span<const std::uint32_t> dofs, bool fixed_base)
    : fixed_base_(fixed_base), body_of_link_(links.size()), pose_in_body_(links.size()) {
  bodies_.emplace_back();
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(links[i].parent);
      body_of_link_[i] = body_of_link_[parent];
      pose_in_body_[i] = pose_in_body_[parent] * links[i].origin;
      if (links[i].joint != JointKind::fixed) {
        Body b;
        b.parent = std::int32_t(body_of_link_[parent]);
        b.link = i;
        b.joint = links[i];
        b.joint.origin = pose_in_body_[i];
        body_of_link_[i] = std::uint32_t(bodies_.size());
        pose_in_body_[i] = Pose{};
        bodies_.push_back(b);
      }
    }
    Body& b = bodies_[body_of_link_[i]];
    b.inertia = b.inertia + inertias[i].in(pose_in_body_[i]);
  }
  for (const Body& b : bodies_) mass_ += b.inertia.mass;
  find_constant_inertias();
  for (Body& b : bodies_) update_kinematics(b, 0);
  update_composite();
  for (const std::uint32_t link : dofs) {
    std::vector<MovedBody> moved;
    std::vector<bool> moves(bodies_.size());
    for (std::uint32_t k = 1; k < bodies_.size(); ++k) {
      const Body& b = bodies_[k];
      const bool own = b.link == link, follows = b.joint.mimic == std::int32_t(link);
      const bool carried = moves[std::size_t(b.parent)];
      moves[k] = own || follows || carried;
      if (!moves[k]) continue;
      moved.push_back({k, carried ? b.parent : -1, own ? 1 : follows ? b.joint.mimic_multiplier : 0});
    }
    dofs_.push_back({link, 0, 0});
    moved_.push_back(std::move(moved));
  }
}

MovedInertias DecoupledDynamics::moved_inertias(double armature) const {
  std::vector<MovedInertias::Body> bodies;
  for (const Body& b : bodies_) {
    bodies.push_back({b.joint, b.inertia});
    bodies.back().link.parent = b.parent;
    bodies.back().link.limits.armature += armature;
  }
  return MovedInertias(std::move(bodies), fixed_base_);
}

void DecoupledDynamics::find(MovedInertias& inertias) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& b = bodies_[i];
    inertias.place(i, {b.pose_in_base.position, b.axis, b.centre, b.tensor});
  }
  inertias.find();
}

void DecoupledDynamics::add_wrench(std::uint32_t link, SumIn<Wrench> wrench) {
  wrenches_.push_back({body_of_link_[link], pose_in_body_[link].position, wrench});
}

/// A wheel keeps its inertia whatever its position, so it carries no other body, and nothing off its axis.
void DecoupledDynamics::find_constant_inertias() {
  for (Body& b : bodies_)
    b.has_constant_inertia =
        b.parent <= 0 && (b.parent < 0 || (b.joint.joint == JointKind::revolute && balanced(b.inertia, b.joint.axis)));
  for (const Body& b : bodies_)
    if (b.parent > 0) bodies_[std::size_t(b.parent)].has_constant_inertia = false;
  for (std::size_t i = 0; i < pose_in_body_.size(); ++i) {
    Body& b = bodies_[body_of_link_[i]];
    if (b.parent >= 0 && b.joint.axis.cross(pose_in_body_[i].position).norm() > 1e-6) b.has_constant_inertia = false;
  }
  for (const Body& b : bodies_) all_constant_ = all_constant_ && b.has_constant_inertia;
}

void DecoupledDynamics::update_kinematics(Body& b, double position) {
  if (b.parent >= 0) {
    b.pose_in_base = bodies_[std::size_t(b.parent)].pose_in_base * pose_in_parent(b.joint, position);
    b.axis = b.pose_in_base.orientation * b.joint.axis;
  }
  const Mat3 rotation = b.pose_in_base.orientation.toRotationMatrix();
  b.centre = b.pose_in_base.position + rotation * b.inertia.com;
  b.tensor = rotation * b.inertia.tensor() * rotation.transpose();
}

/// All bodies as one.
void DecoupledDynamics::update_composite() {
  centre_ = Vec3::Zero();
  tensor_ = Mat3::Zero();
  for (const Body& b : bodies_) centre_ += b.inertia.mass * b.centre;
  centre_ /= mass_;
  for (const Body& b : bodies_) {
    const Vec3 d = b.centre - centre_;
    tensor_ += b.tensor + b.inertia.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  if (!fixed_base_) inverse_ = tensor_.inverse();
}

/// `force`, `torque` on the whole robot at the base's origin, `spin` of the base; axes of the base.
void DecoupledDynamics::add_inertial_forces(const Vec3& force, const Vec3& torque, const Vec3& spin,
                                            const Vec3& gravity) {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero(), rate = Vec3::Zero();  // accelerations; angular velocity
  if (!fixed_base_) {
    rate = spin;
    turn = inverse_ * (torque - centre_.cross(force) - spin.cross(tensor_ * spin));
    origin = force / mass_ + gravity - turn.cross(centre_) - spin.cross(spin.cross(centre_));
  }
  for (Body& b : bodies_) {
    b.force += b.inertia.mass * (gravity - origin - turn.cross(b.centre) - rate.cross(rate.cross(b.centre)));
    b.torque -= b.tensor * turn + rate.cross(b.tensor * rate);
  }
}

void DecoupledDynamics::project_onto(Dof& dof, std::span<const MovedBody> moved) {
  Vec3 momentum = Vec3::Zero();
  dof.inertia = dof.force = 0;
  for (const MovedBody& m : moved) {
    Body& b = bodies_[m.body];
    b.linear = b.angular = Vec3::Zero();
    if (m.carrier >= 0) {
      const Body& by = bodies_[std::size_t(m.carrier)];
      b.angular = by.angular;
      b.linear = by.linear + by.angular.cross(b.pose_in_base.position - by.pose_in_base.position);
    }
    (b.joint.joint == JointKind::revolute ? b.angular : b.linear) += m.rate * b.axis;
    const Vec3 velocity = b.linear + b.angular.cross(b.centre - b.pose_in_base.position);
    const double mass = b.inertia.mass;
    dof.inertia += mass * velocity.squaredNorm() + b.angular.dot(b.tensor * b.angular);
    dof.force += b.force.dot(velocity) + b.torque.dot(b.angular);
    momentum += mass * velocity;
  }
  if (!fixed_base_) dof.inertia -= momentum.squaredNorm() / mass_;
}

Wrench DecoupledDynamics::update(const Pose& pose, const Twist& twist, std::span<const double> positions,
                                 const Vec3& gravity) {
  for (Body& b : bodies_) {
    b.force = b.torque = Vec3::Zero();
    if (!b.has_constant_inertia) update_kinematics(b, positions[b.link]);
  }
  if (!all_constant_ && !fixed_base_) update_composite();
  const Mat3 to_base = pose.orientation.toRotationMatrix().transpose();
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (const AppliedWrench& p : wrenches_) {
    if (p.wrench.size() == 0) continue;
    const Wrench w = p.wrench.value();
    const Vec3 f = to_base * w.force, t = to_base * w.torque;
    Body& b = bodies_[p.body];
    const Vec3 at = b.pose_in_base * p.origin;
    b.force += f;
    b.torque += t + (at - b.centre).cross(f);
    force += f;
    torque += t + at.cross(f);
  }
  add_inertial_forces(force, torque, to_base * twist.angular, to_base * gravity);
  for (std::size_t k = 0; k < dofs_.size(); ++k) project_onto(dofs_[k], moved_[k]);
  return {pose.orientation * force, pose.orientation * torque};
}

}  // namespace muro::simplified
