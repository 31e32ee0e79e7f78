// SPDX-License-Identifier: MIT
#include "composite_body.hpp"
#include "muro/toolkit/link_pose.hpp"

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

/// For every link: whether its joint moves mass relative to the link's parent.
std::vector<bool> find_moving_joints(std::span<const Link> links, std::span<const Inertia> inertias,
                                     std::span<const double> start) {
  std::vector<Inertia> subtree(inertias.begin(), inertias.end());
  std::vector<bool> moves(links.size()), moves_below(links.size());
  for (std::size_t i = links.size(); i-- > 1;) {
    const Link& link = links[i];
    const bool has_mass = subtree[i].mass > 0;
    const bool wheel = link.joint == JointKind::revolute && !moves_below[i] && balanced(subtree[i], link.axis);
    moves[i] = link.joint != JointKind::fixed && has_mass && !wheel;
    const auto parent = std::size_t(link.parent);
    moves_below[parent] = moves_below[parent] || moves[i] || moves_below[i];
    subtree[parent] = subtree[parent] + subtree[i].in(pose_in_parent(link, start[i]));
  }
  return moves;
}

}  // namespace

CompositeBody::CompositeBody(std::span<const Link> links, std::span<const Inertia> inertias,
                             std::span<const double> start) {
  const std::vector<bool> moves = find_moving_joints(links, inertias, start);
  std::vector<std::uint32_t> group_of(links.size());
  std::vector<Pose> in_group(links.size());
  groups_.emplace_back();
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(links[i].parent);
      group_of[i] = group_of[parent];
      in_group[i] = in_group[parent];
      if (moves[i]) {
        Group g;
        g.parent = group_of[parent];
        g.joint = links[i];
        g.joint.origin = in_group[parent] * links[i].origin;
        in_group[i] = Pose{};
        group_of[i] = std::uint32_t(groups_.size());
        groups_.push_back(g);
        joints_.push_back(std::uint32_t(i));
      } else {
        in_group[i] = in_group[parent] * pose_in_parent(links[i], start[i]);
      }
    }
    Group& g = groups_[group_of[i]];
    g.inertia = g.inertia + inertias[i].in(in_group[i]);
  }
  for (const Group& g : groups_) mass_ += g.inertia.mass;
}

MassState CompositeBody::state(std::span<const double> positions, std::span<const double> velocities) {
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
