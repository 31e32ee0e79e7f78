// SPDX-License-Identifier: MIT
#include "live.hpp"

namespace muro::multibody {

void place_parts(const RobotModel& model, const RobotState& state, std::span<PartMotion> out) {
  out[0] = {state.pose, state.twist};
  for (std::size_t i = 1; i < model.parts.size(); ++i) {
    const Part& part = model.parts[i];
    const PartMotion& on = out[std::size_t(part.parent)];
    const JointState& joint = state.joints[i];
    PartMotion& m = out[i];
    m.pose = on.pose * placed(part, joint.position);
    m.twist.angular = on.twist.angular;
    m.twist.linear = on.twist.at(m.pose.position - on.pose.position);
    const Vec3 axis = m.pose.orientation * part.axis;
    (part.joint == JointKind::revolute ? m.twist.angular : m.twist.linear) += axis * joint.velocity;
  }
}

}  // namespace muro::multibody
