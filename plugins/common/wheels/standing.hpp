// SPDX-License-Identifier: MIT
// A rigid base that stands on the ground with several points.
#pragma once

#include <span>

#include "terrain.hpp"

namespace muro::ground {

/// A point of a robot that can stand on the ground.
struct ContactPoint {
  Vec3 at = Vec3::Zero();  ///< m, in the frame of the base
  double weight = 1;       ///< in the least squares of the gaps between points and ground
};

/// The velocity of a base along the plane on which its points stand, in its own axes.
struct Gliding {
  double x = 0, y = 0;  ///< m/s, of the origin
  double yaw_rate = 0;  ///< rad/s, about its z axis
};

/// Height, roll and pitch of a base whose points stand on a terrain. Three points stand exactly. More points stand with
/// the least sum of the squares of the vertical gaps, each times its weight, as if each wheel hung on a spring and all
/// springs were equal. The yaw of the base (of roll-pitch-yaw) and the place of the middle of the points on the map
/// stay the same.
///
/// A point without ground below keeps the height that it had at the pose before. If the z axis of a base is more than
/// 80 deg off the vertical, the base lies and is left as it is.
class Standing {
 public:
  /// `points`: three or more that are not in one line. Both arguments are kept by reference.
  Standing(const Terrain& terrain, std::span<const ContactPoint> points) : terrain_(terrain), points_(points) {}

  /// Puts a base that is at `pose`, and was at `before`, on the ground. [step]
  void settle(const Pose& before, Pose& pose);

  /// Returns the velocity (world axes, at its origin) of a base that stands at `pose` and goes along the ground: the
  /// given velocity `along`, and the rates of its height, roll and pitch. [step]
  Twist velocity(const Pose& pose, const Gliding& along);

 private:
  /// Derivatives of the gap between a point and the ground, in the axes of the heading.
  struct Row {
    Vec3 arm;       ///< m, from the middle of the points
    Vec3 gradient;  ///< derivative by the place of the point
    double gap;     ///< m
    Vec3 jacobian;  ///< derivative by height, pitch and roll
  };

  /// Normal equations of the least squares, for the points' rates: A x = b, A symmetric.
  struct NormalEquations {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3 right = Vec3::Zero();

    void add(double weight, const Vec3& row, double value);
    Vec3 solution() const;
  };

  void take(const Pose& pose);
  void set_axes();
  Row row(const ContactPoint& point) const;
  Vec3 turned(const Vec3& v) const { return {cosine_ * v.x() - sine_ * v.y(), sine_ * v.x() + cosine_ * v.y(), v.z()}; }

  const Terrain& terrain_;
  std::span<const ContactPoint> points_;
  Pose before_{};
  bool is_lying_ = true;
  double cosine_ = 1, sine_ = 0;   ///< of the heading
  Vec3 middle_ = Vec3::Zero();     ///< m, of the points by their weights, in the frame of the base
  Vec3 place_ = Vec3::Zero();      ///< m, of the middle in the world
  double along_ = 0, across_ = 0;  ///< tangents of the ascent of the x-y plane along the heading, and to its left
  Mat3 axes_ = Mat3::Identity();   ///< of the base, in the axes of the heading
};

}  // namespace muro::ground
