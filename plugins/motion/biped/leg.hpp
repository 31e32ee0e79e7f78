// SPDX-License-Identifier: MIT
// Chain of joints from the base of a robot to one of its feet.
#pragma once

#include <vector>

#include "muro/robot.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/link_motion/frame_motion.hpp"

namespace muro::biped {

/// A joint of a leg, in the frame behind the joint before it. Fixed links in between are part of `origin`.
struct LegJoint {
  Pose origin;                ///< pose of the frame in front of the joint
  Vec3 axis = Vec3::UnitX();  ///< unit, in that frame
  JointKind kind = JointKind::revolute;
  bool is_turned = false;    ///< the orientation of `origin` is not the identity
  bool is_shifted = false;   ///< the position of `origin` is not zero
  int axis_number = 0;       ///< 1, 2, 3: `axis` is x, y, z; 0: any
  std::uint32_t number = 0;  ///< number among the joints of both legs

  bool operator==(const LegJoint& b) const {
    return origin.position == b.origin.position && origin.orientation.coeffs() == b.origin.orientation.coeffs() &&
           axis == b.axis && kind == b.kind && number == b.number;
  }
};

/// Pose of a foot in the frame of the base, and velocity of the base by the joints when the foot is held: -J q', with J
/// the Jacobian of the foot at the origin of the base.
struct FootMotion {
  Pose foot;                    ///< pose in the frame of the base
  Vec3 linear = Vec3::Zero();   ///< m/s: velocity of the base, in its axes
  Vec3 angular = Vec3::Zero();  ///< rad/s
};

struct Leg {
  std::vector<LegJoint> joints;
  Pose end;  ///< pose of the link of the foot, in the frame behind the last joint

  bool operator==(const Leg& b) const {
    return joints == b.joints && end.position == b.end.position &&
           end.orientation.coeffs() == b.end.orientation.coeffs();
  }

  /// Returns the foot in the frame of the base. `position(i)`: position of joint `i` of both legs, rad or m.
  template <class Position>
  Pose foot(const Position& position) const {
    Pose at;
    for (const LegJoint& j : joints) pass(j, position(j.number), at);
    return is_at_end() ? at : at * end;
  }

  /// Returns the motion of the foot and the base. `velocity(i)`: velocity of joint `i`, rad/s or m/s.
  template <class Position, class Velocity>
  FootMotion motion(const Position& position, const Velocity& velocity) const {
    FootMotion m;
    for (const LegJoint& j : joints) {
      const double q = position(j.number), rate = velocity(j.number);
      pass(j, q, m.foot);
      const Vec3 speed = turned(m.foot.orientation, j.axis * rate);
      if (j.kind == JointKind::revolute) {
        m.linear += speed.cross(m.foot.position);
        m.angular -= speed;
      } else {
        m.linear -= speed;
      }
    }
    if (!is_at_end()) m.foot = m.foot * end;
    return m;
  }

  /// Returns the motion of the foot in the frame of the base. `acceleration(i)`: of joint `i`, rad/s^2 or m/s^2.
  template <class Position, class Velocity, class Acceleration>
  link_motion::FrameMotion relative(const Position& position, const Velocity& velocity,
                                    const Acceleration& acceleration) const {
    link_motion::FrameMotion m{};
    for (const LegJoint& j : joints)
      m = m.at(j.origin).behind(j.kind, j.axis, position(j.number), velocity(j.number), acceleration(j.number));
    return m.at(end);
  }

 private:
  bool is_at_end() const { return end.position.isZero(0) && end.orientation.vec().isZero(0); }

  static void pass(const LegJoint& j, double q, Pose& at) {
    if (j.is_shifted) at.position += turned(at.orientation, j.origin.position);
    if (j.is_turned) at.orientation = at.orientation * j.origin.orientation;
    if (j.kind == JointKind::revolute)
      turn(j, q, at.orientation);
    else
      at.position += turned(at.orientation, j.axis * q);
  }

  /// Turns `orientation` by rotation_about(axis, q), without the products by 0 if the axis is one of the frame.
  static void turn(const LegJoint& j, double q, Quat& orientation) {
    const auto [s, c] = elementary::sincos(0.5 * q);
    const double x = orientation.x(), y = orientation.y(), z = orientation.z(), w = orientation.w();
    switch (j.axis_number) {
      case 1:
        orientation = Quat(w * c - x * s, x * c + w * s, y * c + z * s, z * c - y * s);
        return;
      case 2:
        orientation = Quat(w * c - y * s, x * c - z * s, y * c + w * s, z * c + x * s);
        return;
      case 3:
        orientation = Quat(w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s);
        return;
      default:
        orientation = orientation * Quat(c, s * j.axis.x(), s * j.axis.y(), s * j.axis.z());
    }
  }

  /// Returns q * v. Compilers do not inline the function of Eigen into this loop.
  static Vec3 turned(const Quat& q, const Vec3& v) {
    const double x = q.x(), y = q.y(), z = q.z(), w = q.w();
    const double tx = 2 * (y * v.z() - z * v.y()), ty = 2 * (z * v.x() - x * v.z()), tz = 2 * (x * v.y() - y * v.x());
    return {v.x() + w * tx + y * tz - z * ty, v.y() + w * ty + z * tx - x * tz, v.z() + w * tz + x * ty - y * tx};
  }
};

}  // namespace muro::biped
