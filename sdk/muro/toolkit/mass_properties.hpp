// SPDX-License-Identifier: MIT
// Mass properties of a whole robot at the start, for algorithms that treat it as one body.
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/base/number_text.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// Position (rad or m) of every link's joint at the start: `joint.position.initial`; for mimic joints the position that
/// follows from the leader's, 0 for fixed ones. [setup]
inline std::vector<double> initial_joint_positions(const Connector& connector, const RobotView& robot) {
  std::vector<double> q(robot.links.size(), 0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Link& f = robot.links[i];
    if (f.joint == JointKind::fixed) continue;
    const Link& own = f.mimic < 0 ? f : robot.links[std::size_t(f.mimic)];  // a leader does not follow another joint
    q[i] = connector.constant(own.joint_object, keys::initial_joint_position).value_or(0.0);
    if (f.mimic >= 0) q[i] = f.mimic_offset + f.mimic_multiplier * q[i];
  }
  return q;
}

/// Throws Error when a joint starts outside of its limits, which is the user's mistake. [setup]
inline void check_start(const Connector& connector, ObjectId joint, const JointLimits& limits, double position) {
  if (position < limits.lower || position > limits.upper)
    throw Error("joint `" + std::string(connector.object_name(joint)) + "` starts at " + number_text(position) +
                ", outside of its limits " + number_text(limits.lower) + " to " + number_text(limits.upper) +
                "; set `joint.position.initial` to a value between them");
}

/// Returns the constant `inertial` of every link; zero when there is none. [setup]
inline std::vector<Inertia> inertias_of(const Connector& connector, const RobotView& robot) {
  std::vector<Inertia> inertias;
  for (const Link& f : robot.links)
    inertias.push_back(connector.constant(f.object, keys::inertial).value_or(Inertia{}));
  return inertias;
}

/// All bodies of a robot as one, in the frame of its base. `inertias`, `positions`: one a link.
inline Inertia composite_inertia(Rows<Link> links, std::span<const Inertia> inertias,
                                 std::span<const double> positions) {
  std::vector<Pose> in_base(links.size());
  Inertia whole;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) in_base[i] = in_base[std::size_t(links[i].parent)] * pose_in_parent(links[i], positions[i]);
    whole = whole + inertias[i].in(in_base[i]);
  }
  return whole;
}

}  // namespace muro
