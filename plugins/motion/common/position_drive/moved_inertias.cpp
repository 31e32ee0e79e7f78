// SPDX-License-Identifier: MIT
#include "moved_inertias.hpp"

#include <algorithm>

namespace muro {

MovedInertias::MovedInertias(std::span<const Body> bodies, bool fixed_base) : fixed_base_(fixed_base) {
  for (const Body& b : bodies) {
    TreeBody& t = bodies_.emplace_back();
    t.parent = bodies_.size() == 1 ? -1 : b.link.parent;
    t.joint = JointFrame(b.link);
    t.armature = b.link.limits.armature;
    t.mass = b.inertia.mass, t.com = plain(b.inertia.com), t.tensor = columns_of(b.inertia.tensor());
  }
}

void MovedInertias::update(std::span<const double> positions) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    TreeBody& b = bodies_[i];
    Placed& p = b.placed;
    if (b.parent >= 0)
      p.frame = b.joint.place(bodies_[std::size_t(b.parent)].placed.frame, positions[i], p.axis);
    else
      p.axis = Vector{};
    p.centre = p.frame.at(b.com);
    p.tensor = turned_by(p.frame.axes, b.tensor);
    b.composite = {b.mass, b.mass * p.centre, p.tensor};
    add_point(b.mass, p.centre, b.composite.second_moment);
  }
  for (std::size_t i = bodies_.size(); i-- > 1;) {
    const Composite& own = bodies_[i].composite;
    Composite& on = bodies_[std::size_t(bodies_[i].parent)].composite;
    on.mass += own.mass;
    on.first_moment += own.first_moment;
    on.second_moment.x += own.second_moment.x;
    on.second_moment.y += own.second_moment.y;
    on.second_moment.z += own.second_moment.z;
  }
}

double MovedInertias::along(std::size_t body, const Composite& c) const {
  const TreeBody& b = bodies_[body];
  if (b.joint.kind() == JointKind::prismatic) return std::max(c.mass, 0.0);
  if (b.joint.kind() == JointKind::fixed) return 0;
  // inertia about a parallel axis through a point p: the sum of m |a x (r - p)|^2
  const Vector &axis = b.placed.axis, &joint = b.placed.frame.origin, arm = joint - dot(axis, joint) * axis;
  return std::max(dot(axis, c.second_moment * axis) - 2 * dot(arm, c.first_moment) + c.mass * dot(arm, arm), 0.0);
}

double MovedInertias::before(std::size_t body) const {
  const Composite &all = composite(0), &own = composite(body);
  const Matrix &a = all.second_moment, &b = own.second_moment;
  return along(body, {all.mass - own.mass, all.first_moment - own.first_moment, {a.x - b.x, a.y - b.y, a.z - b.z}});
}

double MovedInertias::driven(std::size_t body) const {
  const double side = behind(body);
  return (fixed_base_ ? side : std::max(side, before(body))) + bodies_[body].armature;
}

double MovedInertias::free(std::size_t body) const {
  const double side = behind(body), armature = bodies_[body].armature;
  if (fixed_base_) return side + armature;
  const double other = before(body), sum = side + other;
  return (sum > 0 ? side * other / sum : 0) + armature;
}

}  // namespace muro
