// SPDX-License-Identifier: MIT
// The joints of one robot that forces drive: joints in mode effort and passive, with PD drives, and others with limited
// effort (force-driven joints of hybrid dynamics: Featherstone, Rigid Body Dynamics Algorithms, Section 9.2).
#pragma once

#include "decoupled_dynamics.hpp"
#include "dof.hpp"
#include "joint_properties.hpp"
#include "plugins/motion/common/position_drive/drive_losses.hpp"
#include "plugins/motion/common/position_drive/position_target.hpp"

namespace muro::simplified {

/// kg m^2 or kg: least inertia that a joint must move to be driven by forces.
inline constexpr double least_dof_inertia = 1e-12;

class ForceDrivenJoints {
 public:
  struct Settings {
    bool fixed_base = false;
    double max_acceleration = 0;  ///< rad/s^2 or m/s^2: of joints that follow targets
    double armature = 0;          ///< kg m^2 or kg: added to the inertia of every joint here
    bool feels_wrench = true;     ///< the wrench on the base
    bool feels_contact = true;    ///< also wrenches on the other links
  };
  /// `properties`, `inertias`, `start`, `drives`: one per link. `memory`: name of the memory that drives keep from step
  /// to step. Throws Error for a joint without inertia. [setup]
  ForceDrivenJoints(Connector& c, const RobotView& robot, std::span<const JointProperties> properties,
                    std::span<const Inertia> inertias, std::span<const double> start,
                    std::span<const PositionDrive> drives, std::string_view memory, const Settings& settings);
  /// Finds out whether velocities of joints with PD drives are commanded, and connects friction and armature of drives.
  /// [setup]
  void connect_by_name(Connector& c);
  /// Takes the robot over from another motion that has moved it so far.
  void take_over() const;

  /// Computes inertias and forces of the joints, before anything moves. Returns the sum of all wrenches on the robot as
  /// one wrench on the base. `dt`: s.
  Wrench evaluate(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt);
  /// Moves the joints with the results of evaluate(). Returns whether their state is finite.
  bool move(double dt);

 private:
  struct Follower {
    double* position;
    double* velocity;
    double multiplier, offset;
  };
  struct Joint {
    JointProperties properties;
    JointLimits limits;  ///< damping and friction include those of followers
    double min_inertia;  ///< kg m^2 or kg: lower bound of the inertia in all poses of the robot
    Out<double> effort;
    ObjectId object;
    DriveLosses losses;  ///< losses of its drive in mode effort
    PositionDrive drive;
    PositionTarget target;  ///< target of a PD drive
    std::vector<Follower> followers;
  };
  /// Any joint of the robot.
  struct LinkJoint {
    const double* position;
    const double* velocity;
    std::uint32_t link;
  };

  Settings settings_;
  DecoupledDynamics dynamics_;
  bool has_position_drives_ = false;
  std::vector<Joint> joints_;           ///< in the order of dynamics_.dofs()
  std::vector<LinkJoint> link_joints_;  ///< all joints of the robot
  std::vector<double> positions_;       ///< in the middle of the step, one per link
};

}  // namespace muro::simplified
