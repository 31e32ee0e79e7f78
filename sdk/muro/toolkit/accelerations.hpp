// SPDX-License-Identifier: MIT
// Accelerations for motions: the values for accelerometers and force sensors, from velocities before and after a step.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "muro/toolkit/initial_contact.hpp"

namespace muro {

/// Properties that a motion writes, for its description.
inline constexpr PropertyUse writes_acceleration{"acceleration", "of the base, where something reads it"};
inline constexpr PropertyUse writes_joint_acceleration{"joint.acceleration", "of joints, where something reads it"};

/// Way in which a motion moves the base of a robot. It decides how acceleration follows from velocities.
enum class BaseMotion : std::uint8_t {
  /// The motion sets the velocity in body axes: a = R (v_b' - v_b) / h + w x v. An arc at constant speed is exact.
  kinematic,
  /// Forces act at the centre of mass: (v_c' - v_c) / h in world axes. A free fall is exact, also while the body spins.
  by_forces,
};

/// Writes `acceleration` of the base and `joint.acceleration` of joints when something reads them. Otherwise it costs
/// nothing and creates no property. Differences are taken within one step, so hand-overs between motions and changes
/// from outside between steps have no effect.
class Accelerations {
 public:
  /// `vertices`: gives vertices of meshes, for contacts at the start; without it any mesh counts as touched.
  explicit Accelerations(MeshVertices vertices = {}) : vertices_(std::move(vertices)) {}

  /// Connects item `i`. Call in `connect_by_name` of a motion that writes pose, twist and joint velocities. `base`:
  /// inertia of the body that is the base, in its frame; for motions by forces. `keeps_applied`: the motion lets
  /// wrenches act on the links and writes them (keys::applied_wrench). After a step of a motion that does not, these
  /// wrenches are not a number. [setup]
  void connect_by_name(Connector& c, std::uint32_t i, BaseMotion how, const Inertia& base = {},
                       bool keeps_applied = false) {
    const Item& item = c.items()[i];
    OfRobot robot;
    for (const Link& link : item.robot->links)
      if (!keeps_applied && c.is_used(link.object, keys::applied_wrench, usage::read))
        robot.applied.push_back(c.derived(link.object, keys::applied_wrench));
    for (const Link& link : item.robot->links) {
      if (link.joint == JointKind::fixed || !is_read(c, link.joint_object, keys::joint_acceleration)) continue;
      if (!c.is_used(link.joint_object, keys::joint_velocity, usage::variable)) continue;  // no motion moves it
      robot.joints.push_back({c.write(link.joint_object, keys::joint_velocity),
                              c.variable(link.joint_object, keys::joint_acceleration, 0.0), 0});
    }
    const ObjectId object = item.robot->base();
    const bool base_is_read = is_read(c, object, keys::acceleration);
    if (!base_is_read && robot.joints.empty() && robot.applied.empty()) return;
    robot.pose = c.write(object, keys::pose);
    robot.twist = c.write(object, keys::twist);
    robot.how = how;
    robot.com = how == BaseMotion::by_forces ? base.com : Vec3::Zero();
    if (base_is_read) robot.acceleration = c.variable(object, keys::acceleration, initial(c, *item.robot, robot, base));
    if (of_item_.empty()) of_item_.assign(c.items().size(), -1);
    of_item_[i] = std::int32_t(robots_.size());
    robots_.push_back(std::move(robot));
  }

  /// Whether nothing reads an acceleration.
  bool empty() const { return robots_.empty(); }

  /// Call before the motion moves item `i`. [step]
  void begin_step(std::uint32_t i) {
    OfRobot* const r = find(i);
    if (!r) return;
    for (Joint& j : r->joints) j.before = *j.velocity;
    if (!r->acceleration) return;
    if (r->how == BaseMotion::by_forces) {
      r->place_centre();
      r->keep_velocity();
    } else {
      const Quat to_body = r->pose->orientation.conjugate();
      r->before = {to_body * r->twist->linear, to_body * r->twist->angular};
    }
  }

  /// Call after the motion has moved item `i` over a step of `dt` (s). [step]
  void end_step(std::uint32_t i, double dt) {
    OfRobot* const r = find(i);
    if (!r) return;
    const double per_second = 1 / dt;
    for (const Joint& j : r->joints) *j.acceleration = (*j.velocity - j.before) * per_second;
    for (const Out<Wrench>& w : r->applied) *w = {Vec3::Constant(not_known), Vec3::Constant(not_known)};
    if (!r->acceleration) return;
    const Twist& now = *r->twist;
    if (r->how == BaseMotion::by_forces) {
      r->place_centre();
      r->write_acceleration(per_second);
    } else {
      const Quat to_body = r->pose->orientation.conjugate();
      *r->acceleration = r->of_body_axes((to_body * now.linear - r->before.linear) * per_second,
                                         (to_body * now.angular - r->before.angular) * per_second);
    }
  }

  void begin_step(Range items) {
    if (empty()) return;
    for (std::uint32_t i = items.begin; i < items.end; ++i) begin_step(i);
  }

 private:
  static constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  struct Joint {
    Out<double> velocity, acceleration;
    double before = 0;
  };
  struct OfRobot {
    Out<Pose> pose;
    Out<Twist> twist, acceleration;
    BaseMotion how = BaseMotion::kinematic;
    Vec3 com = Vec3::Zero();     ///< m, in the frame of the base
    Twist before;                ///< by_forces: velocity of the centre; kinematic: velocity in the axes of the base
    Vec3 centre = Vec3::Zero();  ///< m, from the base's origin to its centre of mass, in world axes
    double centre_axes[4] = {0, 0, 0, 0};  ///< orientation of the base to which `centre` belongs (x, y, z, w)
    std::vector<Joint> joints;
    std::vector<Out<Wrench>> applied;  ///< applied wrenches of links that another motion of the robot keeps

    /// Updates `centre` if the orientation has changed. Most steps begin with the orientation at which the last step
    /// ended.
    void place_centre() {
      const double* const q = pose->orientation.coeffs().data();
      if (q[0] == centre_axes[0] && q[1] == centre_axes[1] && q[2] == centre_axes[2] && q[3] == centre_axes[3]) return;
      std::copy_n(q, 4, centre_axes);
      const double tx = 2 * (q[1] * com.z() - q[2] * com.y()), ty = 2 * (q[2] * com.x() - q[0] * com.z()),
                   tz = 2 * (q[0] * com.y() - q[1] * com.x());
      centre = {com.x() + q[3] * tx + q[1] * tz - q[2] * ty, com.y() + q[3] * ty + q[2] * tx - q[0] * tz,
                com.z() + q[3] * tz + q[0] * ty - q[1] * tx};
    }
    /// Stores the velocity of the centre, for by_forces. It uses numbers instead of vectors, because it runs for each
    /// robot in each step.
    void keep_velocity() {
      const double *v = twist->linear.data(), *w = twist->angular.data(), *c = centre.data();
      double *linear = before.linear.data(), *angular = before.angular.data();
      linear[0] = v[0] + w[1] * c[2] - w[2] * c[1];
      linear[1] = v[1] + w[2] * c[0] - w[0] * c[2];
      linear[2] = v[2] + w[0] * c[1] - w[1] * c[0];
      for (int i = 0; i < 3; ++i) angular[i] = w[i];
    }
    /// a_O = a_C - alpha x c - w x (w x c)
    void write_acceleration(double per_second) const {
      const double *v = twist->linear.data(), *u = before.linear.data(), *o = before.angular.data();
      const double wx = twist->angular.x(), wy = twist->angular.y(), wz = twist->angular.z();
      const double cx = centre.x(), cy = centre.y(), cz = centre.z();
      const double sx = wy * cz - wz * cy, sy = wz * cx - wx * cz, sz = wx * cy - wy * cx;  // w x c
      const double ax = (wx - o[0]) * per_second, ay = (wy - o[1]) * per_second, az = (wz - o[2]) * per_second;
      double *linear = acceleration->linear.data(), *angular = acceleration->angular.data();
      linear[0] = (v[0] + sx - u[0]) * per_second - (ay * cz - az * cy) - (wy * sz - wz * sy);
      linear[1] = (v[1] + sy - u[1]) * per_second - (az * cx - ax * cz) - (wz * sx - wx * sz);
      linear[2] = (v[2] + sz - u[2]) * per_second - (ax * cy - ay * cx) - (wx * sy - wy * sx);
      angular[0] = ax, angular[1] = ay, angular[2] = az;
    }
    Twist of_body_axes(const Vec3& change, const Vec3& turning) const {
      const Quat& axes = pose->orientation;
      return {axes * change + twist->angular.cross(twist->linear), axes * turning};
    }
    /// a_O = a_C - alpha x c - w x (w x c); place_centre() is called before
    Twist of_centre(const Vec3& change, const Vec3& turning) const {
      const Vec3& w = twist->angular;
      return {change - turning.cross(centre) - w.cross(w.cross(centre)), turning};
    }
  };

  static bool is_read(const Connector& c, ObjectId object, const KeyInfo& key) {
    return c.is_used(object, key, usage::input) || c.is_used(object, key, usage::read);
  }

  OfRobot* find(std::uint32_t i) {
    return of_item_.empty() || of_item_[i] < 0 ? nullptr : &robots_[std::size_t(of_item_[i])];
  }

  /// Initial acceleration. A body that stands, or moves as commanded, keeps its velocity in its own axes. A body that
  /// forces move and that touches nothing falls and turns according to Euler's equations.
  Twist initial(const Connector& c, const RobotView& robot, OfRobot& r, const Inertia& base) {
    if (r.how == BaseMotion::by_forces && !contact_) contact_.emplace(c, vertices_);
    if (r.how == BaseMotion::kinematic || contact_->touches(robot)) return r.of_body_axes(Vec3::Zero(), Vec3::Zero());
    const Vec3 gravity = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    const Quat& axes = r.pose->orientation;
    const Vec3 w = axes.conjugate() * r.twist->angular;
    const Mat3 tensor = base.tensor();
    const bool has_tensor = std::abs(tensor.determinant()) > 0;
    const Vec3 turning = has_tensor ? Vec3(tensor.inverse() * -w.cross(tensor * w)) : Vec3(Vec3::Zero());
    r.place_centre();
    return r.of_centre(gravity, axes * turning);
  }

  std::vector<std::int32_t> of_item_;  ///< for each item: index in robots_; -1: nothing reads its acceleration
  std::vector<OfRobot> robots_;
  MeshVertices vertices_;
  std::optional<InitialContact> contact_;
};

}  // namespace muro
