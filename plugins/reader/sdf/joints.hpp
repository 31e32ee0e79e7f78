// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/mimic_limits.hpp"

namespace muro::sdf {

/// The joints of a robot. A joint of SDFormat with several axes becomes several revolute and prismatic joints.
class Joints {
 public:
  Joints(Assembly& assembly, const SourceFiles& sources, RobotBuilder& builder, Problems& problems);

  /// Adds the transforms and joints from the parent body (the present frame) to the frame of the child body.
  void add(int joint);
  /// Reports mimic joints that their leaders move beyond their limits. Call it after all joints have been added.
  void check_mimic_limits() const;
  /// Adds a translation and a rotation if they are not zero.
  void add_transform(const Pose& pose);

 private:
  /// Definition of one joint of the robot.
  struct SingleDofJoint {
    std::string name;
    unsigned number = 0;  ///< number of the <axis>
    bool is_prismatic = false;
    Vec3 axis = Vec3::UnitZ();  ///< unit, in the frame of the joint
  };
  /// q = offset + multiplier * q_leader.
  struct Follower {
    std::string leader;
    double multiplier = 1, offset = 0;
  };
  std::vector<SingleDofJoint> dofs_of(const Joint& joint);
  std::vector<SingleDofJoint> dofs_of_ball(const Joint& joint);
  Vec3 axis_of(const Joint& joint, unsigned number);
  JointLimits limits_of(const Joint& joint, const SingleDofJoint& dof);
  void add_spring(const Joint& joint, const SingleDofJoint& dof);
  void add_dof(const Joint& joint, const SingleDofJoint& dof, const Quat& rotation);

  void find_mimics();
  void add_gearbox(const Joint& joint);
  std::pair<int, double> wheel(int carrier, int link, const Vec3& axis) const;
  void resolve_followers();

  Assembly& a_;
  const SourceFiles& sources_;
  RobotBuilder& builder_;
  Problems& problems_;
  std::vector<std::vector<SingleDofJoint>> dofs_;  ///< for each joint
  std::map<std::string, Follower> followers_;      ///< by name
  struct Range {
    model_file::JointRange range;
    const Joint* joint = nullptr;
  };
  std::map<std::string, Range> ranges_;  ///< ranges of the joints added so far, by name
};

}  // namespace muro::sdf
