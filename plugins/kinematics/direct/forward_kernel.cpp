// SPDX-License-Identifier: MIT
#include "muro/simd/rows.hpp"
#include "plugins/common/lanes/turn.hpp"
#include "tree_link.hpp"

namespace muro::kinematics {
namespace {

using namespace lane;

/// Returns q rotated about the joint's axis (given in q's own frame). `half`: sine and cosine of half the angle.
template <class S>
MURO_INLINE Q4<S> rotated(const Q4<S>& q, const TreeLink& link, const Turn<S>& half) {
  const S s = half.s, c = half.c;
  switch (link.axis_number) {
    case 1:
      return {q.x * c + q.w * s, q.y * c + q.z * s, q.z * c - q.y * s, q.w * c - q.x * s};
    case 2:
      return {q.x * c - q.z * s, q.y * c + q.w * s, q.z * c + q.x * s, q.w * c - q.y * s};
    case 3:
      return {q.x * c + q.y * s, q.y * c - q.x * s, q.z * c + q.w * s, q.w * c - q.z * s};
    default:
      return q * Q4<S>{S(link.axis[0]) * s, S(link.axis[1]) * s, S(link.axis[2]) * s, c};
  }
}
template <class S>
MURO_INLINE V3<S> axis_in_world(const M3<S>& axes, const TreeLink& link) {
  switch (link.axis_number) {
    case 1:
      return axes.x;
    case 2:
      return axes.y;
    case 3:
      return axes.z;
    default:
      return axes * splat<S>(link.axis);
  }
}

/// RobotState of as many robots as S has values. If there are fewer robots, the first one fills the remaining values.
template <class S>
struct States {
  Places<S> base_pose, base_twist;
  Places<S, double> poses, twists;
  Places<S> positions, velocities;

  MURO_INLINE States(const RobotState* robots, int count) {
    for (int i = 0; i < count_of<S>; ++i) {
      const RobotState& r = robots[i < count ? i : 0];
      base_pose.at[i] = r.base_pose, base_twist.at[i] = r.base_twist;
      poses.at[i] = r.poses, twists.at[i] = r.twists;
      positions.at[i] = r.positions, velocities.at[i] = r.velocities;
    }
  }
};

/// The link from which its children are computed.
template <class S>
struct Parent {
  PoseOf<S> pose;
  TwistOf<S> twist;
  M3<S> axes;

  MURO_INLINE Parent(const PoseOf<S>& p, const TwistOf<S>& t) : pose(p), twist(t), axes(p.orientation.matrix()) {}
};

template <class S>
void forward_lanes(const TreeLink* links, const StateOffsets* offsets, int link_count, const RobotState* robots,
                   int robot_count) {
  const States<S> states(robots, robot_count);
  const unsigned which = first_lanes(robot_count);
  const auto base = [&] { return Parent<S>(load_pose(states.base_pose), load_twist(states.base_twist)); };
  const auto link_at = [&](const StateOffsets& at) {
    return Parent<S>(load_pose(as_read(states.poses), at.pose), load_twist(as_read(states.twists), at.twist));
  };
  int parent = 0;
  Parent<S> from = base();
  PoseOf<S> pose = from.pose;
  TwistOf<S> twist = from.twist;
  for (int k = 0; k < link_count; ++k) {
    const TreeLink& link = links[k];
    const StateOffsets& at = offsets[k];
    if (link.parent != parent) {  // most neighbours share their parent, or one is the parent of the other
      parent = link.parent;
      from = parent == k ? Parent<S>(pose, twist) : parent == 0 ? base() : link_at(offsets[parent - 1]);
    }
    V3<S> arm = from.axes * splat<S>(link.offset);
    pose.orientation = from.pose.orientation;
    twist = from.twist;
    if (link.joint != TreeLink::Joint::fixed) {
      const S rate = load(states.velocities, at.velocity);
      const V3<S> axis = axis_in_world(from.axes, link);
      if (link.joint == TreeLink::Joint::revolute) {
        pose.orientation = rotated(pose.orientation, link, turn_by(S(0.5) * load(states.positions, at.position)));
        twist.angular += axis * rate;
      } else {
        arm += axis * load(states.positions, at.position);
        twist.linear += axis * rate;
      }
    }
    if (link.is_rotated)
      pose.orientation =
          pose.orientation * Q4<S>{S(link.rotation[0]), S(link.rotation[1]), S(link.rotation[2]), S(link.rotation[3])};
    pose.position = from.pose.position + arm;
    twist.linear += cross(from.twist.angular, arm);
    store_pose(states.poses, at.pose, pose, which);
    store_twist(states.twists, at.twist, twist, which);
  }
}

void forward_kinematics(const TreeLink* links, const StateOffsets* offsets, int link_count, const RobotState* robots,
                        int robot_count) {
  // Registers hold the state of one link of this many robots.
  constexpr int at_once = vectors::register_bytes >= 64 ? 8 : 4;
  for (int k = 0; k < robot_count; k += at_once) {
    const int left = robot_count - k;
    in_lanes(left < at_once ? left : at_once, [&]<class S>(int first, int used) {
      forward_lanes<S>(links, offsets, link_count, robots + k + first, used);
      return 0u;
    });
  }
}

}  // namespace

namespace MURO_ISA {
extern const Kernels kernels;
const Kernels kernels{&forward_kinematics};
}  // namespace MURO_ISA

}  // namespace muro::kinematics
