// SPDX-License-Identifier: MIT
// The chain of joints from the base of a robot to one of its feet.
#pragma once

#include <vector>

#include "muro/robot.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/link_acceleration/frame_motion.hpp"

namespace muro::biped {

/// A joint of a leg, in the frame behind the joint before it; fixed links in between are folded in.
struct LegJoint {
  Pose origin;                ///< of the frame in front of the joint
  Vec3 axis = Vec3::UnitX();  ///< unit, in that frame
  JointKind kind = JointKind::revolute;
  bool is_turned = false;    ///< the orientation of `origin` is not the identity
  std::uint32_t number = 0;  ///< among the joints of both legs

  bool operator==(const LegJoint& b) const {
    return origin.position == b.origin.position && origin.orientation.coeffs() == b.origin.orientation.coeffs() &&
           axis == b.axis && kind == b.kind && number == b.number;
  }
};

/// A foot as seen from the base, and what the joints' velocities make of the base when the foot is held: -J q', with J
/// the Jacobian of the foot at the origin of the base.
struct FootMotion {
  Pose foot;                    ///< in the frame of the base
  Vec3 linear = Vec3::Zero();   ///< m/s, of the base, in its axes
  Vec3 angular = Vec3::Zero();  ///< rad/s
};

struct Leg {
  std::vector<LegJoint> joints;
  Pose end;  ///< of the link of the foot, in the frame behind the last joint

  bool operator==(const Leg& b) const {
    return joints == b.joints && end.position == b.end.position &&
           end.orientation.coeffs() == b.end.orientation.coeffs();
  }

  /// The foot in the frame of the base. `position(i)`: of joint `i` of both legs, rad or m.
  template <class Position>
  Pose foot(const Position& position) const {
    Pose at;
    for (const LegJoint& j : joints) pass(j, position(j.number), at);
    return is_at_end() ? at : at * end;
  }

  /// `velocity(i)`: of the joint, rad/s or m/s.
  template <class Position, class Velocity>
  FootMotion motion(const Position& position, const Velocity& velocity) const {
    FootMotion m;
    for (const LegJoint& j : joints) {
      const double q = position(j.number), rate = velocity(j.number);
      pass(j, q, m.foot);
      const Vec3 speed = m.foot.orientation * Vec3(j.axis * rate);
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

  /// How the foot would move if the base stood still, in its frame. `acceleration(i)`: of the joint, rad/s^2 or m/s^2.
  template <class Position, class Velocity, class Acceleration>
  link_acceleration::FrameMotion relative(const Position& position, const Velocity& velocity,
                                          const Acceleration& acceleration) const {
    link_acceleration::FrameMotion m{};
    for (const LegJoint& j : joints)
      m = m.at(j.origin).behind(j.kind, j.axis, position(j.number), velocity(j.number), acceleration(j.number));
    return m.at(end);
  }

 private:
  bool is_at_end() const { return end.position.isZero(0) && end.orientation.vec().isZero(0); }

  static void pass(const LegJoint& j, double q, Pose& at) {
    at.position += at.orientation * j.origin.position;
    if (j.is_turned) at.orientation = at.orientation * j.origin.orientation;
    if (j.kind == JointKind::revolute)
      at.orientation = at.orientation * rotation_about(j.axis, q);
    else
      at.position += at.orientation * Vec3(j.axis * q);
  }
};

}  // namespace muro::biped
