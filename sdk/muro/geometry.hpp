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

  /// Returns the child point `p` (m) in the parent frame.
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
  /// Returns the inertia of this body in another frame, in which the frame of the body has pose `pose`.
  Inertia in(const Pose& pose) const;
  /// Joins two bodies described in the same frame (parallel-axis theorem).
  Inertia operator+(const Inertia& b) const;
  /// Returns the tensor (kg m^2) about the point `centre` (m, same axes).
  Mat3 about(const Vec3& centre) const { return moved_to(centre).tensor(); }

 private:
  /// Returns a copy with `centre` as its com and with the tensor about that point.
  Inertia moved_to(const Vec3& centre) const;
};

}  // namespace muro

#include "muro/detail/inertia.hpp"
