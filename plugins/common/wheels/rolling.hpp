// SPDX-License-Identifier: MIT
// Wheels that roll on a plane, steered or not: what their angles and speeds say of the motion of the base, and the
// other way round. The constraints of standard wheels of Siegwart, Nourbakhsh and Scaramuzza, Introduction to
// Autonomous Mobile Robots, 2nd edition, section 3.2.3, written with vectors.
#pragma once

#include <span>

#include "planar.hpp"
#include "plugins/common/wheels/steered_wheels.hpp"

namespace muro::wheeled {

/// A wheel as the plane sees it, in the frame of its base.
struct PlanarWheel {
  double x = 0, y = 0;    ///< m: a point on the axis that steers it, or its centre
  double ahead = 0;       ///< m: from this axis to its centre, along its rolling direction; below 0: trail
  double aside = 0;       ///< m: the same across, to the left
  double straight = 0;    ///< rad: its rolling direction with the steering at 0, -pi/2 .. pi/2
  double per_metre = 20;  ///< rad/m: what its joint turns by along its rolling direction

  explicit PlanarWheel(const SteeredWheel& w) {
    const bool forward = w.axis.y() > 0 || (w.axis.y() == 0 && w.axis.x() < 0);
    const Vec3 left = forward ? w.axis : Vec3(-w.axis);
    straight = std::atan2(-left.x(), left.y());
    per_metre = (forward ? 1 : -1) / w.radius;
    const Vec3 from = w.steering < 0 ? w.centre : w.pivot, arm = w.centre - from;
    x = from.x(), y = from.y();
    ahead = std::cos(straight) * arm.x() + std::sin(straight) * arm.y();
    aside = std::cos(straight) * arm.y() - std::sin(straight) * arm.x();
  }

  /// Velocity (m/s) of its centre along its rolling direction, at the heading with sine `s` and cosine `c`, when the
  /// base moves at `v` and the steering turns the wheel at `rate` (rad/s).
  double along(double s, double c, const PlanarTwist& v, double rate) const {
    return c * (v.x - v.turn * y) + s * (v.y + v.turn * x) - (v.turn + rate) * aside;
  }
  /// The same across, to the left: 0 for a wheel that does not slip.
  double across(double s, double c, const PlanarTwist& v, double rate) const {
    return c * (v.y + v.turn * x) - s * (v.x - v.turn * y) + (v.turn + rate) * ahead;
  }
};

/// What one wheel does at an instant.
struct Rolling {
  double sine = 0, cosine = 1;  ///< of its heading in the frame of the base
  double rate = 0;              ///< rad/s, of its steering
  double speed = 0;             ///< m/s, along its rolling direction, where it is driven
};

/// A motion of the base that wheels allow.
struct Allowed {
  PlanarTwist velocity;
  bool one_way = true;  ///< the angles leave one motion, which the speeds only make faster or slower
};

/// Finds the motion of a base whose wheels do not slip: across, as their angles say; along, as driven wheels turn.
/// Where that cannot be, least squares: first of the velocities across, over all motions of one size, |v|^2 + (L w)^2 =
/// 1 with v in the middle of the wheels and L their mean distance from it; then of the velocities along of driven
/// wheels, over the motions that are left.
class RollingBase {
 public:
  /// `wheels` at x, y of the base.
  explicit RollingBase(std::span<const PlanarWheel> wheels) {
    for (const PlanarWheel& w : wheels) x_ += w.x / double(wheels.size()), y_ += w.y / double(wheels.size());
    double sum = 0;
    for (const PlanarWheel& w : wheels) sum += (w.x - x_) * (w.x - x_) + (w.y - y_) * (w.y - y_);
    length_ = sum > 0 ? std::sqrt(sum / double(wheels.size())) : 1;
  }

  /// `wheel(i)`, `rolling(i)`, `driven(i)`: of wheel i of `count`. [step]
  template <class WheelOf, class RollingOf, class Driven>
  Allowed velocity(std::size_t count, const WheelOf& wheel, const RollingOf& rolling, const Driven& driven) const {
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 row = across(wheel(i), rolling(i));
      normal += row * row.transpose();
      right -= row * (rolling(i).rate * wheel(i).ahead);
    }
    const Modes modes = modes_of(normal);
    // what the turning of steered wheels itself asks for, across
    Vec3 found = right.isZero(0) ? right : modes.solve(normal, right);
    // what is left to the driven wheels: one mode, or two
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!driven(i)) continue;
      const Vec3 row = along(wheel(i), rolling(i));
      const double wanted = rolling(i).speed + rolling(i).rate * wheel(i).aside - row.dot(found);
      const double a = row.dot(modes.first), b = row.dot(modes.second);
      aa += a * a, ab += a * b, bb += b * b, ra += a * wanted, rb += b * wanted;
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * (aa + bb) * (aa + bb))
      found += (modes.first * (bb * ra - ab * rb) + modes.second * (aa * rb - ab * ra)) / determinant;
    else if (aa + bb > 1e-12)  // a wheel in the centre of rotation drives nothing
      found += (modes.first * ra + modes.second * rb) / (aa + bb);
    return {at_base(found), modes.second.isZero(0)};
  }

 private:
  /// The motions across which wheels slip least: unit, one, or two where all axles are one; else `second` is zero.
  struct Modes {
    Vec3 first, second = Vec3::Zero();

    /// The solution of normal x = right that has nothing of the modes.
    Vec3 solve(const Mat3& normal, const Vec3& right) const {
      const double size = normal.trace();
      const Mat3 regular = normal + size * (first * first.transpose() + second * second.transpose());
      return regular.inverse() * (right - first * first.dot(right) - second * second.dot(right));
    }
  };

  /// The eigenvector of the smallest eigenvalue: the only one left in the adjugate where that is 0, as it is for angles
  /// that fit together; otherwise Rayleigh's iteration goes on from there.
  static Modes modes_of(const Mat3& normal);

  /// What a wheel does of a motion of the middle, with the turn rate as a velocity at `length_`.
  Vec3 across(const PlanarWheel& w, const Rolling& r) const {
    return {-r.sine, r.cosine, (r.cosine * (w.x - x_) + r.sine * (w.y - y_) + w.ahead) / length_};
  }
  Vec3 along(const PlanarWheel& w, const Rolling& r) const {
    return {r.cosine, r.sine, (r.sine * (w.x - x_) - r.cosine * (w.y - y_) - w.aside) / length_};
  }
  PlanarTwist at_base(const Vec3& v) const {
    const double turn = v.z() / length_;
    return {v.x() + turn * y_, v.y() - turn * x_, turn};
  }
  double x_ = 0, y_ = 0;  ///< m, in the frame of the base: the middle of the wheels
  double length_ = 1;     ///< m
};

}  // namespace muro::wheeled
