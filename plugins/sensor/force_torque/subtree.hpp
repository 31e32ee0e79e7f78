// SPDX-License-Identifier: MIT
// Newton's and Euler's equations of all links beyond a connection.
#pragma once

#include <vector>

#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/link_motion/link_motion.hpp"
#include "plugins/sensor/common/internal_sensor/link_load.hpp"

namespace muro {

class Subtree {
 public:
  Subtree() = default;
  /// Takes link `link` and all links behind it. Throws Error if they have no mass. [setup]
  Subtree(Connector& c, const RobotView& robot, std::uint32_t link) {
    const std::vector<double> start = initial_joint_positions(c, robot);
    const std::vector<Inertia> inertias = inertias_of(c, robot);
    std::vector<std::int32_t> number(robot.links.size(), -1);
    double mass = 0;
    for (std::uint32_t i = link; i < robot.links.size(); ++i) {
      const Link& l = robot.links[i];
      const bool is_first = i == link;
      if (!is_first && number[std::size_t(l.parent)] < 0) continue;
      number[i] = std::int32_t(parts_.size());
      Part part;
      part.parent = is_first ? -1 : number[std::size_t(l.parent)];
      part.origin = is_first ? Pose{} : l.origin;
      part.kind = is_first ? JointKind::fixed : l.joint;
      part.axis = l.axis;
      if (part.kind != JointKind::fixed) part.joint = {c, robot, i, start[i], link_motion::Order::acceleration};
      part.inertia = inertias[i];
      part.tensor = inertias[i].tensor();
      part.load = {c, robot, i, internal_sensor::Load::all};
      mass += part.inertia.mass;
      parts_.push_back(std::move(part));
    }
    if (!(mass > 0))
      throw Error("what lies beyond `" + std::string(c.object_name(robot.links[link].object)) +
                  "` has no mass, so it has neither weight nor inertia; give its links `inertial`");
    motions_.resize(parts_.size());
  }

  /// See LinkMotion::check. [setup]
  void check(const Connector& c) const {
    for (const Part& p : parts_)
      if (p.kind != JointKind::fixed) p.joint.check_acceleration(c);
  }

  /// See LinkLoad.
  bool reads_other_robots() const {
    return std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.load.reads_other_robots(); });
  }

  /// Returns the wrench that the connection must apply, about the point `about` (m), so that the links move as they do:
  /// world axes. `first`: motion of the frame of the first link; `gravity`: m/s^2. [step]
  Wrench holding_wrench(const link_motion::FrameMotion& first, const Vec3& about, const Vec3& gravity) {
    Wrench sum;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& p = parts_[i];
      link_motion::FrameMotion& m = motions_[i];
      m = p.parent < 0 ? first : motions_[std::size_t(p.parent)].at(p.origin);
      if (p.kind != JointKind::fixed)
        m = m.behind(p.kind, p.axis, p.joint.position(), p.joint.velocity(), p.joint.acceleration());
      if (p.inertia.mass > 0) add_inertia(p, m, about, gravity, sum);
      const Wrench load = p.load.wrench(m.pose.position);
      sum.add_force(-load.force, m.pose.position - about);
      sum.torque -= load.torque;
    }
    return sum;
  }

 private:
  struct Part {
    std::int32_t parent = -1;  ///< -1: the first link
    Pose origin;               ///< in the parent's frame, with the joint at 0
    JointKind kind = JointKind::fixed;
    Vec3 axis = Vec3::UnitX();
    link_motion::JointMotion joint;
    Inertia inertia;
    Mat3 tensor = Mat3::Zero();
    internal_sensor::LinkLoad load;
  };

  /// Adds m (a_c - g) at the centre of mass, and I alpha + w x I w.
  static void add_inertia(const Part& p, const link_motion::FrameMotion& m, const Vec3& about, const Vec3& gravity,
                          Wrench& sum) {
    const Quat& axes = m.pose.orientation;
    const Vec3 com = axes * p.inertia.com, &w = m.twist.angular, &alpha = m.acceleration.angular;
    const Vec3 a = m.acceleration.linear + alpha.cross(com) + w.cross(w.cross(com));
    sum.add_force(p.inertia.mass * (a - gravity), m.pose.position + com - about);
    const Vec3 w_body = axes.conjugate() * w, alpha_body = axes.conjugate() * alpha;
    sum.torque += axes * Vec3(p.tensor * alpha_body + w_body.cross(p.tensor * w_body));
  }

  std::vector<Part> parts_;
  std::vector<link_motion::FrameMotion> motions_;  ///< scratch
};

}  // namespace muro
