// SPDX-License-Identifier: MIT
// For motions: what accelerometers and force sensors read, from the velocities before and after a step.
#pragma once

#include <optional>

#include "muro/toolkit/initial_contact.hpp"

namespace muro {

/// For the description of a motion: what it writes.
inline constexpr PropertyUse writes_acceleration{"acceleration", "of the base, where something reads it"};
inline constexpr PropertyUse writes_joint_acceleration{"joint.acceleration", "of joints, where something reads it"};

/// How a motion moves the base of a robot; so its acceleration follows from its velocities.
enum class BaseMotion : std::uint8_t {
  /// As its velocity in its own axes says: a = R (v_b' - v_b) / h + w x v. An arc at constant speed is exact.
  kinematic,
  /// As forces at its centre of mass say: (v_c' - v_c) / h in world axes. A free fall is exact, also while it spins.
  by_forces,
};

/// Writes `acceleration` of the base and `joint.acceleration` of joints where somebody reads them; elsewhere it costs
/// nothing and makes no property. Differences are taken within one step, so hand-overs between motions and what is
/// moved from outside between steps leave no trace.
class Accelerations {
 public:
  /// Of item `i`; in the `connect_by_name` of a motion that writes pose, twist and joint velocities. `base`: of the
  /// body that is the base, in its frame; for motions by forces. [setup]
  void connect_by_name(Connector& c, std::uint32_t i, BaseMotion how, const Inertia& base = {}) {
    const Item& item = c.items()[i];
    OfRobot robot;
    for (const Link& link : item.robot->links) {
      if (link.joint == JointKind::fixed || !is_read(c, link.joint_object, keys::joint_acceleration)) continue;
      if (!c.is_used(link.joint_object, keys::joint_velocity, usage::variable)) continue;  // no motion moves it
      robot.joints.push_back({c.write(link.joint_object, keys::joint_velocity),
                              c.variable(link.joint_object, keys::joint_acceleration, 0.0), 0});
    }
    const ObjectId object = item.robot->base();
    const bool base_is_read = is_read(c, object, keys::acceleration);
    if (!base_is_read && robot.joints.empty()) return;
    robot.pose = c.write(object, keys::pose);
    robot.twist = c.write(object, keys::twist);
    robot.how = how;
    robot.com = how == BaseMotion::by_forces ? base.com : Vec3::Zero();
    if (base_is_read) robot.acceleration = c.variable(object, keys::acceleration, initial(c, *item.robot, robot, base));
    if (of_item_.empty()) of_item_.assign(c.items().size(), -1);
    of_item_[i] = std::int32_t(robots_.size());
    robots_.push_back(std::move(robot));
  }

  /// Whether nobody reads an acceleration.
  bool empty() const { return robots_.empty(); }

  /// Before the motion carries item `i` on. [step]
  void begin_step(std::uint32_t i) {
    OfRobot* const r = find(i);
    if (!r) return;
    r->before = velocity(*r);
    for (Joint& j : r->joints) j.before = *j.velocity;
  }

  /// When it has carried it on by `dt` (s). [step]
  void end_step(std::uint32_t i, double dt) const {
    const OfRobot* const r = const_cast<Accelerations*>(this)->find(i);
    if (!r) return;
    for (const Joint& j : r->joints) *j.acceleration = (*j.velocity - j.before) / dt;
    if (!r->acceleration) return;
    const Twist now = velocity(*r);
    const Vec3 change = (now.linear - r->before.linear) / dt, turning = (now.angular - r->before.angular) / dt;
    *r->acceleration =
        r->how == BaseMotion::kinematic ? of_body_axes(*r, change, turning) : of_centre(*r, change, turning);
  }

  void begin_step(Range items) {
    if (empty()) return;
    for (std::uint32_t i = items.begin; i < items.end; ++i) begin_step(i);
  }
  void end_step(Range items, double dt) const {
    if (empty()) return;
    for (std::uint32_t i = items.begin; i < items.end; ++i) end_step(i, dt);
  }

 private:
  struct Joint {
    Out<double> velocity, acceleration;
    double before = 0;
  };
  struct OfRobot {
    Out<Pose> pose;
    Out<Twist> twist, acceleration;
    BaseMotion how = BaseMotion::kinematic;
    Vec3 com = Vec3::Zero();  ///< m, in the frame of the base
    Twist before;             ///< as `velocity` gives it
    std::vector<Joint> joints;
  };

  static bool is_read(const Connector& c, ObjectId object, const KeyInfo& key) {
    return c.is_used(object, key, usage::input) || c.is_used(object, key, usage::read);
  }

  OfRobot* find(std::uint32_t i) {
    return of_item_.empty() || of_item_[i] < 0 ? nullptr : &robots_[std::size_t(of_item_[i])];
  }

  /// Of the origin in the axes of the base, or of the centre of mass in those of the world.
  static Twist velocity(const OfRobot& r) {
    const Twist& v = *r.twist;
    if (r.how == BaseMotion::by_forces) return {v.at(r.pose->orientation * r.com), v.angular};
    const Quat to_body = r.pose->orientation.conjugate();
    return {to_body * v.linear, to_body * v.angular};
  }

  static Twist of_body_axes(const OfRobot& r, const Vec3& change, const Vec3& turning) {
    const Quat& axes = r.pose->orientation;
    return {axes * change + r.twist->angular.cross(r.twist->linear), axes * turning};
  }
  /// a_O = a_C - alpha x c - w x (w x c)
  static Twist of_centre(const OfRobot& r, const Vec3& change, const Vec3& turning) {
    const Vec3 c = r.pose->orientation * r.com, &w = r.twist->angular;
    return {change - turning.cross(c) - w.cross(w.cross(c)), turning};
  }

  /// What stands, or moves as commanded, keeps its velocity in its own axes; what forces move and touches nothing falls
  /// and turns as Euler's equations say.
  Twist initial(const Connector& c, const RobotView& robot, const OfRobot& r, const Inertia& base) {
    if (r.how == BaseMotion::by_forces && !contact_) contact_.emplace(c);
    if (r.how == BaseMotion::kinematic || contact_->touches(robot)) return of_body_axes(r, Vec3::Zero(), Vec3::Zero());
    const Vec3 gravity = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    const Quat& axes = r.pose->orientation;
    const Vec3 w = axes.conjugate() * r.twist->angular;
    const Mat3 tensor = base.tensor();
    const bool has_tensor = std::abs(tensor.determinant()) > 0;
    const Vec3 turning = has_tensor ? Vec3(tensor.inverse() * -w.cross(tensor * w)) : Vec3(Vec3::Zero());
    return of_centre(r, gravity, axes * turning);
  }

  std::vector<std::int32_t> of_item_;  ///< place in robots_; -1: nobody reads of it
  std::vector<OfRobot> robots_;
  std::optional<InitialContact> contact_;
};

}  // namespace muro
