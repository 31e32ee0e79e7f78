// SPDX-License-Identifier: MIT
#include "moving_mass.hpp"

namespace muro::simplified {

bool balanced(const Inertia& body, const Vec3& axis) {
  if ((body.com - body.com.dot(axis) * axis).norm() > 1e-6) return false;
  const Mat3 tensor = body.tensor();
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  const double margin = 1e-6 * tensor.trace();
  const auto small = [&](double value) { return std::abs(value) <= margin; };
  return small(u.dot(tensor * axis)) && small(v.dot(tensor * axis)) && small(u.dot(tensor * v)) &&
         small(u.dot(tensor * u) - v.dot(tensor * v));
}

namespace {

/// For every frame: whether its joint moves mass relative to the frame's parent.
std::vector<bool> movers(std::span<const Link> frames, std::span<const Inertia> inertias,
                         std::span<const double> start) {
  std::vector<Inertia> subtree(inertias.begin(), inertias.end());
  std::vector<bool> moves(frames.size()), moves_below(frames.size());
  for (std::size_t i = frames.size(); i-- > 1;) {
    const Link& f = frames[i];
    const bool heavy = subtree[i].mass > 0;
    const bool wheel = f.joint == JointKind::revolute && !moves_below[i] && balanced(subtree[i], f.axis);
    moves[i] = f.joint != JointKind::fixed && heavy && !wheel;
    const auto parent = std::size_t(f.parent);
    moves_below[parent] = moves_below[parent] || moves[i] || moves_below[i];
    subtree[parent] = subtree[parent] + subtree[i].in(pose_in_parent(f, start[i]));
  }
  return moves;
}

}  // namespace

MovingMass::MovingMass(std::span<const Link> frames, std::span<const Inertia> inertias, std::span<const double> start) {
  const std::vector<bool> moves = movers(frames, inertias, start);
  std::vector<std::uint32_t> group_of(frames.size());
  std::vector<Pose> in_group(frames.size());
  groups_.emplace_back();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(frames[i].parent);
      group_of[i] = group_of[parent];
      in_group[i] = in_group[parent];
      if (moves[i]) {
        Group g;
        g.parent = group_of[parent];
        g.joint = frames[i];
        g.joint.origin = in_group[parent] * frames[i].origin;
        in_group[i] = Pose{};
        group_of[i] = std::uint32_t(groups_.size());
        groups_.push_back(g);
        joints_.push_back(std::uint32_t(i));
      } else {
        in_group[i] = in_group[parent] * pose_in_parent(frames[i], start[i]);
      }
    }
    Group& g = groups_[group_of[i]];
    g.inertia = g.inertia + inertias[i].in(in_group[i]);
  }
  for (const Group& g : groups_) mass_ += g.inertia.mass;
}

MassState MovingMass::state(std::span<const double> positions, std::span<const double> velocities) {
  MassState s;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& g = groups_[i];
    if (i > 0) {
      const Group& parent = groups_[g.parent];
      const double q = positions[i - 1], rate = velocities[i - 1];
      g.in_base = parent.in_base * pose_in_parent(g.joint, q);
      const Vec3 axis = parent.in_base.orientation * Vec3(g.joint.origin.orientation * g.joint.axis);
      g.motion.angular = parent.motion.angular;
      g.motion.linear = parent.motion.at(g.in_base.position - parent.in_base.position);
      (g.joint.joint == JointKind::revolute ? g.motion.angular : g.motion.linear) += axis * rate;
    }
    const Vec3 arm = g.in_base.orientation * g.inertia.com;
    s.com += g.inertia.mass * (g.in_base.position + arm);
    s.com_velocity += g.inertia.mass * g.motion.at(arm);
  }
  s.com /= mass_;
  s.com_velocity /= mass_;
  for (const Group& g : groups_) s.tensor += g.inertia.in(g.in_base).about(s.com);
  return s;
}

}  // namespace muro::simplified
