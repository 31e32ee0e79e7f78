// SPDX-License-Identifier: MIT
// Rigid-body geometry in SI units: metres, radians, kilograms, newtons.
// Frames follow ROS REP-103: x forward, y left, z up, right-handed.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace muro {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Unit quaternion, stored x, y, z, w. Unaligned, so that values pack without padding.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Position and orientation of a child frame in a parent frame: x_parent = orientation * x_child + position.
struct Pose {
  Vec3 position = Vec3::Zero();         ///< m
  Quat orientation = Quat::Identity();  ///< unit quaternion

  /// The child point `p` (m) in the parent frame.
  Vec3 operator*(const Vec3& p) const { return orientation * p + position; }
  /// Chains two poses: (parent<-child) * (child<-grandchild).
  Pose operator*(const Pose& b) const { return {*this * b.position, Quat(orientation * b.orientation)}; }
  Pose inverse() const {
    const Quat back = orientation.conjugate();
    return {back * Vec3(-position), back};
  }
};

/// Velocity of a rigid body at the origin of its own frame, in the axes of the world.
struct Twist {
  Vec3 linear = Vec3::Zero();   ///< m/s
  Vec3 angular = Vec3::Zero();  ///< rad/s

  /// Velocity (m/s) of the point of the body that lies at `offset` (m, world axes) from the twist's origin.
  Vec3 at(const Vec3& offset) const { return linear + angular.cross(offset); }
};

/// Force and torque, in the axes of the world, referred to the origin of the body's frame.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 torque = Vec3::Zero();  ///< N m

  Wrench& operator+=(const Wrench& b) {
    force += b.force;
    torque += b.torque;
    return *this;
  }
  /// Adds a force (N) that acts at `offset` (m) from the origin the wrench refers to.
  void add_force(const Vec3& applied, const Vec3& offset) {
    force += applied;
    torque += offset.cross(applied);
  }
};

/// Mass, centre of mass and rotational inertia about the centre of mass, in the axes of the body's frame.
struct Inertia {
  double mass = 0;                   ///< kg
  Vec3 com = Vec3::Zero();           ///< m
  double ixx = 0, iyy = 0, izz = 0;  ///< kg m^2
  double ixy = 0, ixz = 0, iyz = 0;  ///< kg m^2, elements of the tensor (as in URDF)

  Mat3 tensor() const {
    Mat3 m;
    m << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
    return m;
  }
  static Inertia from(double mass, const Vec3& com, const Mat3& tensor) {
    return {mass, com, tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(0, 2), tensor(1, 2)};
  }
  /// The same body described in a frame in which this body's frame has pose `pose`.
  Inertia in(const Pose& pose) const {
    const Mat3 r = pose.orientation.toRotationMatrix();
    return from(mass, pose * com, r * tensor() * r.transpose());
  }
  /// Joins two bodies described in the same frame (parallel-axis theorem).
  Inertia operator+(const Inertia& b) const {
    const double total = mass + b.mass;
    if (total <= 0) return {};
    const Vec3 centre = (mass * com + b.mass * b.com) / total;
    return from(total, centre, about(centre) + b.about(centre));
  }
  /// The tensor (kg m^2) about the point `centre` (m, same axes).
  Mat3 about(const Vec3& centre) const {
    const Vec3 d = com - centre;
    return tensor() + mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
};

/// The rotation by the vector `v` (axis times angle, rad).
inline Quat rotation_of(const Vec3& v) {
  const double x = 0.25 * v.squaredNorm();  // square of the half angle
  if (x < 0.01) {                           // series, exact to the last digit: the turns of single steps
    const double c = 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90))));
    const double s = 0.5 * (1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72 * (1 - x / 110)))));
    return Quat(c, s * v.x(), s * v.y(), s * v.z());
  }
  const double half = std::sqrt(x), s = 0.5 * std::sin(half) / half;
  return Quat(std::cos(half), s * v.x(), s * v.y(), s * v.z());
}

/// The mean of the rotations by t * v for t in [0, 1] (v: axis times angle, rad): a body that turns by `v`
/// while its own frame moves at the constant velocity u travels screw_integral(v) * u per unit of time.
inline Mat3 screw_integral(const Vec3& v) {
  const double angle2 = v.squaredNorm(), angle = std::sqrt(angle2);
  const bool small = angle < 1e-3;  // series where the quotients lose digits
  const double a = small ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double b = small ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  Mat3 cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return Mat3::Identity() + a * cross + b * cross * cross;
}

/// Rotation angle (rad) about the z axis: the yaw of the field's roll-pitch-yaw.
inline double yaw_of(const Quat& q) {
  return std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

/// Fixed-axis roll, pitch, yaw (rad), as in URDF: Rz(yaw) Ry(pitch) Rx(roll).
inline Quat from_rpy(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd;
  return Quat(AngleAxisd(yaw, Vec3::UnitZ()) * AngleAxisd(pitch, Vec3::UnitY()) * AngleAxisd(roll, Vec3::UnitX()));
}

}  // namespace muro
