// SPDX-License-Identifier: MIT
#include "forward_kinematics.hpp"

namespace muro::multibody {

void forward_kinematics(const RobotModel& model, const RobotState& state, std::span<BodyState> out) {
  out[0] = {state.pose, state.twist};
  for (std::size_t i = 1; i < model.bodies.size(); ++i) {
    const RigidBody& body = model.bodies[i];
    const BodyState& parent = out[std::size_t(body.parent)];
    const JointState& joint = state.joints[i];
    BodyState& s = out[i];
    s.pose = parent.pose * pose_in_parent(body, joint.position);
    s.twist.angular = parent.twist.angular;
    s.twist.linear = parent.twist.at(s.pose.position - parent.pose.position);
    const Vec3 axis = s.pose.orientation * body.axis;
    (body.joint == JointKind::revolute ? s.twist.angular : s.twist.linear) += axis * joint.velocity;
  }
}

}  // namespace muro::multibody
