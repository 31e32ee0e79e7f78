// SPDX-License-Identifier: MIT
#include "point_mobility.hpp"

#include <Eigen/LU>

namespace muro::articulated {

namespace {

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

PointMobility::PointMobility(const multibody::RobotModel& model) : fixed_base_(model.fixed_base) {
  for (const multibody::RigidBody& body : model.bodies) {
    Body& to = bodies_.emplace_back();
    to.parent = body.parent;
    to.slides = body.joint == JointKind::prismatic;
    to.axis = body.axis;
    to.armature = body.limits.armature;
    to.own = body.inertia;
  }
}

void PointMobility::set_poses(std::span<const Pose> poses) {
  origin_ = poses[0].position;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const Inertia own = body.own.in({Vec3::Zero(), poses[i].orientation});
    const Vec3 arm = poses[i].position - origin_;
    const Mat3 lever = own.mass * cross_matrix(arm + own.com);
    body.inertia.topLeftCorner<3, 3>() = own.tensor() - lever * cross_matrix(arm + own.com);
    body.inertia.topRightCorner<3, 3>() = lever;
    body.inertia.bottomLeftCorner<3, 3>() = -lever;
    body.inertia.bottomRightCorner<3, 3>() = own.mass * Mat3::Identity();
    const Vec3 axis = poses[i].orientation * body.axis;
    if (body.slides)
      body.direction << Vec3::Zero(), axis;
    else
      body.direction << axis, arm.cross(axis);
  }
  for (std::size_t i = bodies_.size(); i-- > 1;) {
    Body& body = bodies_[i];
    body.moved = body.inertia * body.direction;
    body.give = 1 / (body.direction.dot(body.moved) + body.armature);
    bodies_[std::size_t(body.parent)].inertia += body.inertia - body.moved * (body.give * body.moved.transpose());
  }
  if (!fixed_base_) base_inverse_ = bodies_.front().inertia.partialPivLu().inverse();
}

/// Marks the way from a body to the base.
void PointMobility::mark_way(std::uint32_t body) {
  for (auto i = std::int32_t(body); i >= 0 && !bodies_[std::size_t(i)].is_on_way; i = bodies_[std::size_t(i)].parent) {
    bodies_[std::size_t(i)].is_on_way = true;
    bodies_[std::size_t(i)].wrench.setZero();
  }
}

Mat3 PointMobility::between(std::uint32_t a, std::uint32_t b, const Vec3& point) {
  const Mat3 arm = cross_matrix(point - origin_);
  for (Body& body : bodies_) body.is_on_way = false;
  mark_way(a);
  mark_way(b);
  Columns unit;
  unit << arm, Mat3::Identity();
  bodies_[a].wrench -= unit;
  bodies_[b].wrench += unit;
  for (std::size_t i = std::max(a, b); i >= 1; --i) {
    Body& body = bodies_[i];
    if (!body.is_on_way) continue;
    body.effort = -body.give * (body.direction.transpose() * body.wrench);
    bodies_[std::size_t(body.parent)].wrench += body.wrench + body.moved * body.effort;
  }
  bodies_.front().acceleration.setZero();
  if (!fixed_base_) bodies_.front().acceleration = -base_inverse_ * bodies_.front().wrench;
  for (std::size_t i = 1; i <= std::max(a, b); ++i) {
    Body& body = bodies_[i];
    if (!body.is_on_way) continue;
    const Columns& parent = bodies_[std::size_t(body.parent)].acceleration;
    body.acceleration = parent + body.direction * (body.effort - body.give * (body.moved.transpose() * parent));
  }
  const Columns relative = bodies_[a].acceleration - bodies_[b].acceleration;
  return relative.bottomRows<3>() - arm * relative.topRows<3>();
}

}  // namespace muro::articulated
