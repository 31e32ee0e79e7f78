// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/robot.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::link_motion {

/// Motion of a frame in the world. All values are in world axes, at the frame's origin.
struct FrameMotion {
  Pose pose;
  Twist twist;
  Twist acceleration;  ///< m/s^2, rad/s^2

  /// Returns the motion of a frame that is fixed at `origin` in this one.
  FrameMotion at(const Pose& origin) const {
    FrameMotion m = moved_by(pose.orientation * origin.position);
    m.pose.orientation = pose.orientation * origin.orientation;
    return m;
  }

  /// Returns the motion of the frame behind a joint about, or along, `axis` (unit, in this frame) at `position`. The
  /// terms are those of Featherstone, Rigid Body Dynamics Algorithms (2008), section 3.3, with the derivative of the
  /// velocity of a point.
  FrameMotion behind(JointKind kind, const Vec3& axis, double position, double velocity, double rate) const {
    const Vec3 axis_in_world = pose.orientation * axis, speed = axis_in_world * velocity;
    if (kind == JointKind::revolute) {
      FrameMotion m = *this;
      m.pose.orientation = pose.orientation * rotation_about(axis, position);
      m.twist.angular += speed;
      m.acceleration.angular += axis_in_world * rate + twist.angular.cross(speed);
      return m;
    }
    FrameMotion m = moved_by(axis_in_world * position);
    m.twist.linear += speed;
    m.acceleration.linear += axis_in_world * rate + 2 * twist.angular.cross(speed);
    return m;
  }

 private:
  /// Returns the motion of this frame with its origin moved by `arm` (m, world axes).
  FrameMotion moved_by(const Vec3& arm) const {
    const Vec3 &w = twist.angular, sweep = w.cross(arm);
    FrameMotion m = *this;
    m.pose.position += arm;
    m.twist.linear += sweep;
    m.acceleration.linear += acceleration.angular.cross(arm) + w.cross(sweep);
    return m;
  }
};

}  // namespace muro::link_motion
