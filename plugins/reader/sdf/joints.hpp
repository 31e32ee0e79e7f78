// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/mimic_limits.hpp"

namespace muro::sdf {

/// The joints of a robot. A joint of SDFormat with several axes becomes a dofs of revolute and prismatic ones.
class Joints {
 public:
  Joints(Assembly& assembly, const SourceFiles& sources, RobotBuilder& builder, Problems& problems);

  /// Adds what leads from the parent body, whose frame is the present one, to the frame of the child body.
  void add(int joint);
  /// When all have been added: tells of mimic joints that their leaders take beyond their limits.
  void check_mimic_limits() const;
  /// A translation and a rotation, where they are not zero.
  void add_transform(const Pose& pose);

 private:
  /// What becomes one joint of the robot.
  struct SingleDofJoint {
    std::string name;
    unsigned number = 0;  ///< of the <axis>
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
  std::vector<std::vector<SingleDofJoint>> dofs_;  ///< of each joint
  std::map<std::string, Follower> followers_;      ///< by name
  struct Range {
    model_file::JointRange range;
    const Joint* joint = nullptr;
  };
  std::map<std::string, Range> ranges_;  ///< of all joints so far, by name
};

}  // namespace muro::sdf
