// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// The joints of a robot. A joint of SDFormat with several axes becomes a chain of revolute and prismatic ones.
class Joints {
 public:
  Joints(Assembly& assembly, const Sources& sources, RobotBuilder& builder, Problems& problems);

  /// From the body that is the joint's parent, whose frame is the present one, to where the child's body begins.
  void add(int bond);
  /// A shift and a turn, where there are any.
  void place(const Pose& pose);

 private:
  /// What becomes a joint of the robot.
  struct Hinge {
    std::string name;
    unsigned number = 0;  ///< of the <axis>
    bool slides = false;
    Vec3 axis = Vec3::UnitZ();  ///< unit, in the frame of the joint
  };
  /// q = offset + multiplier * q_leader.
  struct Follower {
    std::string leader;
    double multiplier = 1, offset = 0;
  };
  std::vector<Hinge> hinges_of(const Bond& bond);
  Vec3 axis_of(const Bond& bond, unsigned number);
  JointLimits limits_of(const Bond& bond, const Hinge& hinge);
  void put(const Bond& bond, const Hinge& hinge, const Quat& turn);

  void take_mimics();
  void take_gear(const Bond& bond);
  std::pair<int, double> wheel(int carrier, int link, const Vec3& axis) const;
  void resolve_followers();

  Assembly& a_;
  const Sources& sources_;
  RobotBuilder& builder_;
  Problems& problems_;
  std::vector<std::vector<Hinge>> hinges_;     ///< of each bond
  std::map<std::string, Follower> followers_;  ///< by the name of the hinge
};

}  // namespace muro::sdf
