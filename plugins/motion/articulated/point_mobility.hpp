// SPDX-License-Identifier: MIT
// Mobility of two bodies of a robot under equal and opposite forces at a point.
#pragma once

#include <span>
#include <vector>

#include "plugins/motion/common/multibody/robot_model.hpp"

namespace muro::articulated {

/// Finds J M^-1 J', with J the Jacobian of the velocity of one body against another at a point, by the articulated-body
/// algorithm with unit forces (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 7.3). Joints count as free;
/// if something holds them, the mobility is only smaller.
class PointMobility {
 public:
  PointMobility() = default;
  /// Takes the bodies of the model. [setup]
  explicit PointMobility(const multibody::RobotModel& model);
  /// Sets the poses of the bodies (world), by number.
  void set_poses(std::span<const Pose> poses);
  /// Returns the change of the velocity of body `a` against body `b` at `point` (m, world) by an impulse on `a` there
  /// and the opposite impulse on `b`. 1/kg, world axes.
  Mat3 between(std::uint32_t a, std::uint32_t b, const Vec3& point);

 private:
  using Spatial = Eigen::Matrix<double, 6, 1>;  ///< angular, linear at origin_; for wrenches torque, force
  using Columns = Eigen::Matrix<double, 6, 3>;
  struct Body {
    std::int32_t parent = -1;
    bool slides = false;
    Vec3 axis = Vec3::UnitX();                                                  ///< in its frame
    double armature = 0;                                                        ///< kg m^2 or kg
    Inertia own;                                                                ///< in its frame
    Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();  ///< articulated
    Spatial direction = Spatial::Zero(), moved = Spatial::Zero();               ///< of the joint, and inertia times it
    double give = 0;                                                            ///< 1 / inertia that the joint moves
    bool is_on_way = false;
    Columns wrench = Columns::Zero(), acceleration = Columns::Zero();
    Eigen::RowVector3d effort = Eigen::RowVector3d::Zero();
  };

  void mark_way(std::uint32_t body);

  std::vector<Body> bodies_;
  bool fixed_base_ = false;
  Vec3 origin_ = Vec3::Zero();
  Eigen::Matrix<double, 6, 6> base_inverse_ = Eigen::Matrix<double, 6, 6>::Zero();
};

}  // namespace muro::articulated
