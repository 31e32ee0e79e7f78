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

/// Finds for every link whether its joint moves mass relative to the link's parent.
std::vector<bool> find_moving_joints(Rows<Link> links, std::span<const Inertia> inertias,
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

CompositeBody::CompositeBody(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> start) {
  const std::vector<bool> moves = find_moving_joints(links, inertias, start);
  std::vector<std::uint32_t> group_of(links.size());
  std::vector<Pose> in_group(links.size());
  std::vector<Inertia> of_groups(1);
  groups_.emplace_back();
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(links[i].parent);
      group_of[i] = group_of[parent];
      in_group[i] = in_group[parent];
      if (moves[i]) {
        Link joint = links[i];
        joint.origin = in_group[parent] * links[i].origin;
        in_group[i] = Pose{};
        group_of[i] = std::uint32_t(groups_.size());
        Group& g = groups_.emplace_back();
        g.parent = group_of[parent], g.joint = JointFrame(joint);
        of_groups.emplace_back();
        joints_.push_back(std::uint32_t(i));
      } else {
        in_group[i] = in_group[parent] * pose_in_parent(links[i], start[i]);
      }
    }
    Inertia& inertia = of_groups[group_of[i]];
    inertia = inertia + inertias[i].in(in_group[i]);
  }
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& g = groups_[i];
    g.mass = of_groups[i].mass, g.com = plain(of_groups[i].com), g.tensor = columns_of(of_groups[i].tensor());
    mass_ += g.mass;
  }
}

MassState CompositeBody::state(std::span<const double> positions, std::span<const double> velocities) {
  using Vector = lane::V3<double>;
  Vector moment{0, 0, 0}, momentum{0, 0, 0};
  lane::M3<double> tensor{};  // about the origin of the base
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& g = groups_[i];
    if (i > 0) {
      const Group& parent = groups_[g.parent];
      Vector axis;
      g.in_base = g.joint.place(parent.in_base, positions[i - 1], axis);
      g.motion.angular = parent.motion.angular;
      g.motion.linear = parent.motion.linear + cross(parent.motion.angular, g.in_base.origin - parent.in_base.origin);
      (g.joint.kind() == JointKind::revolute ? g.motion.angular : g.motion.linear) += velocities[i - 1] * axis;
    }
    const Vector arm = g.in_base.axes * g.com, centre = g.in_base.origin + arm;
    moment += g.mass * centre;
    momentum += g.mass * (g.motion.linear + cross(g.motion.angular, arm));
    const lane::M3<double> own = turned_by(g.in_base.axes, g.tensor);
    tensor.x += own.x, tensor.y += own.y, tensor.z += own.z;
    add_point(g.mass, centre, tensor);
  }
  const Vector com = moment * (1 / mass_), velocity = momentum * (1 / mass_);
  add_point(-mass_, com, tensor);
  return {vector_of(com), vector_of(velocity), matrix_of(tensor)};
}

}  // namespace muro::simplified
