// SPDX-License-Identifier: MIT
// The joints of one robot that forces drive: those in mode effort and passive, and others whose effort is limited
// (force-driven joints of hybrid dynamics: Featherstone, Rigid Body Dynamics Algorithms, Section 9.2).
#pragma once

#include "decoupled_dynamics.hpp"
#include "dof.hpp"
#include "joint_properties.hpp"

namespace muro::simplified {

class ForceDrivenJoints {
 public:
  struct Settings {
    bool fixed_base = false;
    double max_acceleration = 0;  ///< rad/s^2 or m/s^2: of joints that follow targets
    double armature = 0;          ///< kg m^2 or kg: adds to the inertia of every joint here
  };
  /// `properties`, `inertias`, `start`: one per link. Throws Error for a joint without inertia. [setup]
  ForceDrivenJoints(Connector& c, const RobotView& robot, std::span<const JointProperties> properties,
                    std::span<const Inertia> inertias, std::span<const double> start, const Settings& settings);

  /// Finds inertias and forces of the joints, before anything moves; returns all that acts on the robot as one wrench
  /// on the base. `dt`: s.
  Wrench evaluate(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt);
  /// Moves the joints by what evaluate() has found. Whether their state is finite.
  bool move(double dt);

 private:
  struct Follower {
    double* position;
    double* velocity;
    double multiplier, offset;
  };
  struct Joint {
    JointProperties properties;
    JointLimits limits;  ///< damping and friction: with those of followers
    double min_inertia;  ///< kg m^2 or kg: what remains of the inertia, however the robot folds
    Out<double> effort;
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
  std::vector<Joint> joints_;           ///< as dynamics_.dofs()
  std::vector<LinkJoint> link_joints_;  ///< all joints of the robot
  std::vector<double> positions_;       ///< in the middle of the step, one per link
};

}  // namespace muro::simplified
