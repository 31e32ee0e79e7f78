// SPDX-License-Identifier: MIT
// Rigid-body geometry in SI units: metres, radians, kilograms, newtons.
// Frames follow ROS REP-103: x forward, y left, z up, right-handed.
// Every source of muro includes this file: what is written with numbers instead of Eigen's expressions is so because a
// compiler would instantiate these each time.
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
    double turned[3][3] = {};  // r * tensor, then that * r^T
    for (int i = 0; i < 3; ++i) {
      const double x = r(i, 0), y = r(i, 1), z = r(i, 2);
      const double row[3] = {x * ixx + y * ixy + z * ixz, x * ixy + y * iyy + z * iyz, x * ixz + y * iyz + z * izz};
      for (int j = 0; j < 3; ++j) turned[i][j] = row[0] * r(j, 0) + row[1] * r(j, 1) + row[2] * r(j, 2);
    }
    return {mass, pose * com, turned[0][0], turned[1][1], turned[2][2], turned[0][1], turned[0][2], turned[1][2]};
  }
  /// Joins two bodies described in the same frame (parallel-axis theorem).
  Inertia operator+(const Inertia& b) const {
    const double total = mass + b.mass;
    if (total <= 0) return {};
    Vec3 centre;
    for (int i = 0; i < 3; ++i) centre[i] = (mass * com[i] + b.mass * b.com[i]) / total;
    const Inertia f = moved_to(centre), g = b.moved_to(centre);
    return {total, centre, f.ixx + g.ixx, f.iyy + g.iyy, f.izz + g.izz, f.ixy + g.ixy, f.ixz + g.ixz, f.iyz + g.iyz};
  }
  /// The tensor (kg m^2) about the point `centre` (m, same axes).
  Mat3 about(const Vec3& centre) const { return moved_to(centre).tensor(); }

 private:
  /// With the tensor about `centre`.
  Inertia moved_to(const Vec3& centre) const {
    const double x = com.x() - centre.x(), y = com.y() - centre.y(), z = com.z() - centre.z();
    return {mass,
            centre,
            ixx + mass * (y * y + z * z),
            iyy + mass * (x * x + z * z),
            izz + mass * (x * x + y * y),
            ixy - mass * x * y,
            ixz - mass * x * z,
            iyz - mass * y * z};
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
  const double x = v.x(), y = v.y(), z = v.z();  // 1 + a [v] + b [v]^2, with [v]^2 = v v^T - |v|^2
  Mat3 mean;
  mean << 1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y,  //
      b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x,      //
      b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y);
  return mean;
}

/// Rotation angle (rad) about the z axis: the yaw of the field's roll-pitch-yaw.
inline double yaw_of(const Quat& q) {
  return std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

/// Fixed-axis roll, pitch, yaw (rad), as in URDF: Rz(yaw) Ry(pitch) Rx(roll).
inline Quat from_rpy(double roll, double pitch, double yaw) {
  const Quat x(std::cos(roll / 2), std::sin(roll / 2), 0, 0), y(std::cos(pitch / 2), 0, std::sin(pitch / 2), 0),
      z(std::cos(yaw / 2), 0, 0, std::sin(yaw / 2));
  return z * y * x;
}

/// The shortest turn that takes the direction `from` to the direction `to` (unit vectors).
inline Quat turn_between(const Vec3& from, const Vec3& to) {
  const double w = 1 + from.x() * to.x() + from.y() * to.y() + from.z() * to.z();
  if (w < 1e-14) {  // opposite: half a turn about any axis across
    const bool along_x = std::abs(from.x()) > 0.7;
    const double x = along_x ? from.z() : 0, y = along_x ? 0 : from.z(), z = along_x ? -from.x() : -from.y();
    const double size = std::sqrt(x * x + y * y + z * z);
    return Quat(0, x / size, y / size, z / size);
  }
  const double x = from.y() * to.z() - from.z() * to.y(), y = from.z() * to.x() - from.x() * to.z(),
               z = from.x() * to.y() - from.y() * to.x(), size = std::sqrt(x * x + y * y + z * z + w * w);
  return Quat(w / size, x / size, y / size, z / size);
}

}  // namespace muro
