// SPDX-License-Identifier: MIT
#include "linkage.hpp"

#include <Eigen/LU>

#include "moving_mass.hpp"

namespace muro::simplified {

Linkage::Linkage(std::span<const Link> frames, std::span<const Inertia> inertias, std::span<const std::uint32_t> dofs,
                 bool fixed_base)
    : fixed_base_(fixed_base), link_of_(frames.size()), in_link_(frames.size()) {
  links_.emplace_back();
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(frames[i].parent);
      link_of_[i] = link_of_[parent];
      in_link_[i] = in_link_[parent] * frames[i].origin;
      if (frames[i].joint != JointKind::fixed) {
        RigidGroup l;
        l.parent = std::int32_t(link_of_[parent]);
        l.frame = i;
        l.joint = frames[i];
        l.joint.origin = in_link_[i];
        link_of_[i] = std::uint32_t(links_.size());
        in_link_[i] = Pose{};
        links_.push_back(l);
      }
    }
    RigidGroup& l = links_[link_of_[i]];
    l.inertia = l.inertia + inertias[i].in(in_link_[i]);
  }
  for (const RigidGroup& l : links_) mass_ += l.inertia.mass;
  find_still_links();
  for (RigidGroup& l : links_) place(l, 0);
  weigh();
  for (const std::uint32_t frame : dofs) {
    std::vector<Moved> moved;
    std::vector<bool> moves(links_.size());
    for (std::uint32_t k = 1; k < links_.size(); ++k) {
      const RigidGroup& l = links_[k];
      const bool own = l.frame == frame, follows = l.joint.mimic == std::int32_t(frame);
      const bool carried = moves[std::size_t(l.parent)];
      moves[k] = own || follows || carried;
      if (!moves[k]) continue;
      moved.push_back({k, carried ? l.parent : -1, own ? 1 : follows ? l.joint.mimic_multiplier : 0});
    }
    dofs_.push_back({frame, 0, 0});
    moved_.push_back(std::move(moved));
  }
}

void Linkage::add_touch(std::uint32_t frame, SumIn<Wrench> wrench) {
  places_.push_back({link_of_[frame], in_link_[frame].position, wrench});
}

/// A still link has its place whatever its position, so it carries no other link, and nothing off its axis.
void Linkage::find_still_links() {
  for (RigidGroup& l : links_)
    l.still =
        l.parent <= 0 && (l.parent < 0 || (l.joint.joint == JointKind::revolute && balanced(l.inertia, l.joint.axis)));
  for (const RigidGroup& l : links_)
    if (l.parent > 0) links_[std::size_t(l.parent)].still = false;
  for (std::size_t i = 0; i < in_link_.size(); ++i) {
    RigidGroup& l = links_[link_of_[i]];
    if (l.parent >= 0 && l.joint.axis.cross(in_link_[i].position).norm() > 1e-6) l.still = false;
  }
  for (const RigidGroup& l : links_) still_ = still_ && l.still;
}

void Linkage::place(RigidGroup& l, double position) {
  if (l.parent >= 0) {
    l.in_base = links_[std::size_t(l.parent)].in_base * pose_in_parent(l.joint, position);
    l.axis = l.in_base.orientation * l.joint.axis;
  }
  const Mat3 turn = l.in_base.orientation.toRotationMatrix();
  l.centre = l.in_base.position + turn * l.inertia.com;
  l.tensor = turn * l.inertia.tensor() * turn.transpose();
}

/// All links as one.
void Linkage::weigh() {
  centre_ = Vec3::Zero();
  tensor_ = Mat3::Zero();
  for (const RigidGroup& l : links_) centre_ += l.inertia.mass * l.centre;
  centre_ /= mass_;
  for (const RigidGroup& l : links_) {
    const Vec3 d = l.centre - centre_;
    tensor_ += l.tensor + l.inertia.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  if (!fixed_base_) inverse_ = tensor_.inverse();
}

/// `force`, `torque` on the whole robot at the base's origin, `spin` of the base; axes of the base.
void Linkage::add_motion_of_base(const Vec3& force, const Vec3& torque, const Vec3& spin, const Vec3& gravity) {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero(), rate = Vec3::Zero();  // accelerations; angular velocity
  if (!fixed_base_) {
    rate = spin;
    turn = inverse_ * (torque - centre_.cross(force) - spin.cross(tensor_ * spin));
    origin = force / mass_ + gravity - turn.cross(centre_) - spin.cross(spin.cross(centre_));
  }
  for (RigidGroup& l : links_) {
    l.force += l.inertia.mass * (gravity - origin - turn.cross(l.centre) - rate.cross(rate.cross(l.centre)));
    l.torque -= l.tensor * turn + rate.cross(l.tensor * rate);
  }
}

void Linkage::sum_up(Dof& dof, std::span<const Moved> moved) {
  Vec3 momentum = Vec3::Zero();
  dof.inertia = dof.force = 0;
  for (const Moved& m : moved) {
    RigidGroup& l = links_[m.link];
    l.linear = l.angular = Vec3::Zero();
    if (m.carrier >= 0) {
      const RigidGroup& by = links_[std::size_t(m.carrier)];
      l.angular = by.angular;
      l.linear = by.linear + by.angular.cross(l.in_base.position - by.in_base.position);
    }
    (l.joint.joint == JointKind::revolute ? l.angular : l.linear) += m.rate * l.axis;
    const Vec3 velocity = l.linear + l.angular.cross(l.centre - l.in_base.position);
    const double mass = l.inertia.mass;
    dof.inertia += mass * velocity.squaredNorm() + l.angular.dot(l.tensor * l.angular);
    dof.force += l.force.dot(velocity) + l.torque.dot(l.angular);
    momentum += mass * velocity;
  }
  if (!fixed_base_) dof.inertia -= momentum.squaredNorm() / mass_;
}

Wrench Linkage::update(const Pose& pose, const Twist& twist, std::span<const double> positions, const Vec3& gravity) {
  for (RigidGroup& l : links_) {
    l.force = l.torque = Vec3::Zero();
    if (!l.still) place(l, positions[l.frame]);
  }
  if (!still_ && !fixed_base_) weigh();
  const Mat3 to_base = pose.orientation.toRotationMatrix().transpose();
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (const Place& p : places_) {
    if (p.wrench.size() == 0) continue;
    const Wrench w = p.wrench.value();
    const Vec3 f = to_base * w.force, t = to_base * w.torque;
    RigidGroup& l = links_[p.link];
    const Vec3 at = l.in_base * p.origin;
    l.force += f;
    l.torque += t + (at - l.centre).cross(f);
    force += f;
    torque += t + at.cross(f);
  }
  add_motion_of_base(force, torque, to_base * twist.angular, to_base * gravity);
  for (std::size_t k = 0; k < dofs_.size(); ++k) sum_up(dofs_[k], moved_[k]);
  return {pose.orientation * force, pose.orientation * torque};
}

}  // namespace muro::simplified
