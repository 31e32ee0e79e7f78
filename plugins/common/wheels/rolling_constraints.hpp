// SPDX-License-Identifier: MIT
// Wheels that roll on a plane without slip, steered or not: the motions of the base that their angles and speeds allow.
// Uses the rolling and sliding constraints of standard wheels of Siegwart, Nourbakhsh and Scaramuzza, Introduction to
// Autonomous Mobile Robots, 2nd edition, section 3.2.3, written with vectors.
#pragma once

#include <span>

#include "muro/base/elementary.hpp"
#include "planar_motion.hpp"
#include "steered_wheels.hpp"

namespace muro::wheels {

/// A wheel in the plane, in the frame of its base.
struct PlanarWheel {
  double x = 0, y = 0;          ///< m: a point on the axis that steers it, or its centre
  double forward_offset = 0;    ///< m: from this point to its centre, along its rolling direction; below 0: trail
  double left_offset = 0;       ///< m: from this point to its centre, to the left of its rolling direction
  double zero_heading = 0;      ///< rad: rolling direction with the steering at 0, -pi/2 .. pi/2
  double angle_per_metre = 20;  ///< rad/m: of its joint, along its rolling direction

  explicit PlanarWheel(const SteeredWheel& w) {
    const bool forward = w.axis.y() > 0 || (w.axis.y() == 0 && w.axis.x() < 0);
    const Vec3 left = forward ? w.axis : Vec3(-w.axis);
    zero_heading = elementary::atan2(-left.x(), left.y());
    angle_per_metre = (forward ? 1 : -1) / w.radius;
    const Vec3 from = w.steering < 0 ? w.centre : w.pivot, arm = w.centre - from;
    x = from.x(), y = from.y();
    const auto [sine, cosine] = elementary::sincos(zero_heading);
    forward_offset = cosine * arm.x() + sine * arm.y();
    left_offset = cosine * arm.y() - sine * arm.x();
  }

  /// Returns the velocity (m/s) of its centre along its rolling direction, at the heading with sine `s` and cosine `c`,
  /// if the base moves at `v` and the steering turns the wheel at `rate` (rad/s).
  double longitudinal_velocity(double s, double c, const PlanarTwist& v, double rate) const {
    return c * (v.x - v.yaw_rate * y) + s * (v.y + v.yaw_rate * x) - (v.yaw_rate + rate) * left_offset;
  }
  /// Returns the velocity (m/s) of its centre to the left of its rolling direction: 0 for a wheel that does not slip.
  double lateral_velocity(double s, double c, const PlanarTwist& v, double rate) const {
    return c * (v.y + v.yaw_rate * x) - s * (v.x - v.yaw_rate * y) + (v.yaw_rate + rate) * forward_offset;
  }
};

/// Heading and speed of a wheel at an instant.
struct WheelState {
  double sine = 0, cosine = 1;  ///< of its heading in the frame of the base
  double steering_rate = 0;     ///< rad/s
  double speed = 0;             ///< m/s, along its rolling direction, if it is driven
};

/// A motion of the base that its wheels allow.
struct RollingMotion {
  PlanarTwist velocity;
  int degree_of_mobility = 1;  ///< 1: the angles leave one motion, and speeds only set its size; or 2
};

/// Finds the motion of a base whose wheels do not slip: the lateral velocity at their headings is zero (sliding
/// constraints), and the longitudinal velocity follows from the turn of driven wheels (rolling constraints). If that is
/// not possible, it uses least squares in two steps. The first minimises the lateral velocities over all motions of one
/// size, |v|^2 + (L w)^2 = 1 with v in the middle of the wheels and L their mean distance from it. The second minimises
/// the errors of the longitudinal velocities of driven wheels, over the remaining motions.
class RollingConstraints {
 public:
  /// `wheels` have x, y in the frame of the base.
  explicit RollingConstraints(std::span<const PlanarWheel> wheels) {
    for (const PlanarWheel& w : wheels) x_ += w.x / double(wheels.size()), y_ += w.y / double(wheels.size());
    double sum = 0;
    for (const PlanarWheel& w : wheels) sum += (w.x - x_) * (w.x - x_) + (w.y - y_) * (w.y - y_);
    length_ = sum > 0 ? std::sqrt(sum / double(wheels.size())) : 1;
  }

  /// Returns the motion. `wheel(i)`, `state(i)`, `is_driven(i)`: of wheel i of `count`. [step]
  template <class WheelOf, class StateOf, class IsDriven>
  RollingMotion motion(std::size_t count, const WheelOf& wheel, const StateOf& state, const IsDriven& is_driven) const {
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 row = lateral_row(wheel(i), state(i));
      normal += row * row.transpose();
      right -= row * (state(i).steering_rate * wheel(i).forward_offset);
    }
    const NullSpace free = null_space_of(normal);
    // the motion that the sliding constraints require while wheels are being steered
    Vec3 found = right.isZero(0) ? right : free.solve(normal, right);
    // the rest, which the constraints leave free, follows from the driven wheels
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_driven(i)) continue;
      const Vec3 row = longitudinal_row(wheel(i), state(i));
      const double wanted = state(i).speed + state(i).steering_rate * wheel(i).left_offset - row.dot(found);
      const double a = row.dot(free.first), b = row.dot(free.second);
      aa += a * a, ab += a * b, bb += b * b, ra += a * wanted, rb += b * wanted;
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * (aa + bb) * (aa + bb))
      found += (free.first * (bb * ra - ab * rb) + free.second * (aa * rb - ab * ra)) / determinant;
    else if (aa + bb > 1e-12)  // a wheel in the centre of rotation has no effect
      found += (free.first * ra + free.second * rb) / (aa + bb);
    return {at_base(found), free.second.isZero(0) ? 1 : 2};
  }

 private:
  /// Motions in which wheels slip least sideways, as unit vectors: one, or two if all wheels have one axle. `second` is
  /// zero if there is one.
  struct NullSpace {
    Vec3 first, second = Vec3::Zero();

    /// Returns the solution of normal x = right that is orthogonal to both.
    Vec3 solve(const Mat3& normal, const Vec3& right) const {
      const double size = normal.trace();
      const Mat3 regular = normal + size * (first * first.transpose() + second * second.transpose());
      return regular.inverse() * (right - first * first.dot(right) - second * second.dot(right));
    }
  };

  /// Returns the eigenvector of the smallest eigenvalue. If that eigenvalue is 0, as for angles that fit together, the
  /// adjugate gives it exactly; otherwise Rayleigh's iteration continues from there.
  static NullSpace null_space_of(const Mat3& normal);

  /// Returns the lateral velocity of a wheel by motion of the middle, with the turn rate as a velocity at `length_`.
  Vec3 lateral_row(const PlanarWheel& w, const WheelState& s) const {
    return {-s.sine, s.cosine, (s.cosine * (w.x - x_) + s.sine * (w.y - y_) + w.forward_offset) / length_};
  }
  Vec3 longitudinal_row(const PlanarWheel& w, const WheelState& s) const {
    return {s.cosine, s.sine, (s.sine * (w.x - x_) - s.cosine * (w.y - y_) - w.left_offset) / length_};
  }
  PlanarTwist at_base(const Vec3& v) const {
    const double yaw_rate = v.z() / length_;
    return {v.x() + yaw_rate * y_, v.y() - yaw_rate * x_, yaw_rate};
  }
  double x_ = 0, y_ = 0;  ///< m, in the frame of the base: the middle of the wheels
  double length_ = 1;     ///< m
};

}  // namespace muro::wheels
