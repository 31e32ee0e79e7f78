// SPDX-License-Identifier: MIT
#include "decoupled_dynamics.hpp"

#include <Eigen/LU>

#include "composite_body.hpp"

namespace muro::simplified {

DecoupledDynamics::DecoupledDynamics(Rows<Link> links, std::span<const Inertia> inertias,
                                     std::span<const std::uint32_t> dofs, bool fixed_base, double armature)
    : fixed_base_(fixed_base), body_of_link_(links.size()), pose_in_body_(links.size()) {
  std::vector<MovedInertias::Body> tree = join(links, inertias);
  for (MovedInertias::Body& b : tree) {
    mass_ += b.inertia.mass;
    b.link.limits.armature += armature;
  }
  find_constant_inertias(tree);
  tree_ = MovedInertias(tree, fixed_base);
  positions_.resize(bodies_.size());
  find_places(std::vector<double>(links.size()));
  for (const std::uint32_t link : dofs) {
    std::vector<MovedBody> moved;
    std::vector<bool> moves(bodies_.size());
    bool has_followers = false;
    for (std::uint32_t k = 1; k < bodies_.size(); ++k) {
      const Body& b = bodies_[k];
      const Link& joint = tree[k].link;
      const bool own = b.link == link, follows = joint.mimic == std::int32_t(link);
      const bool carried = moves[std::size_t(b.parent)];
      moves[k] = own || follows || carried;
      has_followers = has_followers || follows;
      if (!moves[k]) continue;
      moved.push_back({k, carried ? b.parent : -1, own ? 1 : follows ? joint.mimic_multiplier : 0});
    }
    if (!has_followers) moved.clear();
    dofs_.push_back({link, 0, 0});
    moved_.push_back(std::move(moved));
  }
}

/// Joins links to bodies.
std::vector<MovedInertias::Body> DecoupledDynamics::join(Rows<Link> links, std::span<const Inertia> inertias) {
  std::vector<MovedInertias::Body> tree(1);
  bodies_.emplace_back();
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    if (i > 0) {
      const auto parent = std::size_t(links[i].parent);
      body_of_link_[i] = body_of_link_[parent];
      pose_in_body_[i] = pose_in_body_[parent] * links[i].origin;
      if (links[i].joint != JointKind::fixed) {
        MovedInertias::Body b{links[i], {}};
        b.link.parent = std::int32_t(body_of_link_[parent]);
        b.link.origin = pose_in_body_[i];
        body_of_link_[i] = std::uint32_t(tree.size());
        pose_in_body_[i] = Pose{};
        Body& body = bodies_.emplace_back();
        body.parent = b.link.parent, body.link = i, body.joint = links[i].joint;
        tree.push_back(b);
      }
    }
    Inertia& inertia = tree[body_of_link_[i]].inertia;
    inertia = inertia + inertias[i].in(pose_in_body_[i]);
  }
  for (std::size_t i = 0; i < tree.size(); ++i) bodies_[i].mass = tree[i].inertia.mass;
  return tree;
}

void DecoupledDynamics::add_wrench(std::uint32_t link, SumIn<Wrench> wrench) {
  wrenches_.push_back({body_of_link_[link], plain(pose_in_body_[link].position), wrench});
}

/// Finds the base and wheels. A wheel has the same inertia in every position, so it carries no other body, and no link
/// off its axis.
void DecoupledDynamics::find_constant_inertias(std::span<const MovedInertias::Body> tree) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& b = bodies_[i];
    b.has_constant_inertia =
        b.parent <= 0 &&
        (b.parent < 0 || (b.joint == JointKind::revolute && balanced(tree[i].inertia, tree[i].link.axis)));
  }
  for (const Body& b : bodies_)
    if (b.parent > 0) bodies_[std::size_t(b.parent)].has_constant_inertia = false;
  for (std::size_t i = 0; i < pose_in_body_.size(); ++i) {
    const std::uint32_t body = body_of_link_[i];
    if (body > 0 && tree[body].link.axis.cross(pose_in_body_[i].position).norm() > 1e-6)
      bodies_[body].has_constant_inertia = false;
  }
  for (const Body& b : bodies_) all_constant_ = all_constant_ && b.has_constant_inertia;
}

/// Finds the places of all bodies, and the centre and inertia of all together.
void DecoupledDynamics::find_places(std::span<const double> positions) {
  for (std::size_t i = 1; i < bodies_.size(); ++i)
    positions_[i] = bodies_[i].has_constant_inertia ? 0 : positions[bodies_[i].link];
  tree_.update(positions_);
  const MovedInertias::Composite& all = tree_.composite(0);
  centre_ = all.first_moment * (1 / mass_);
  tensor_ = all.second_moment;
  add_point(-mass_, centre_, tensor_);
  if (fixed_base_) return;
  inverse_ = columns_of(matrix_of(tensor_).inverse());
}

/// Adds gravity and inertial forces to all bodies. `force`, `torque`: on the whole robot at the base's origin; `spin`:
/// of the base; in axes of the base.
void DecoupledDynamics::add_inertial_forces(const Vector& force, const Vector& torque, const Vector& spin,
                                            const Vector& gravity) {
  Vector origin{0, 0, 0}, turn{0, 0, 0}, rate{0, 0, 0};  // accelerations; angular velocity
  if (!fixed_base_) {
    rate = spin;
    turn = inverse_ * (torque - cross(centre_, force) - cross(spin, tensor_ * spin));
    origin = force * (1 / mass_) + gravity - cross(turn, centre_) - cross(spin, cross(spin, centre_));
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& b = bodies_[i];
    const MovedInertias::Placed& p = tree_.placed(i);
    const Vector f = b.mass * (gravity - origin - cross(turn, p.centre) - cross(rate, cross(rate, p.centre)));
    b.force += f;
    b.torque += cross(p.centre, f) - (p.tensor * turn + cross(rate, p.tensor * rate));
  }
}

/// Adds to each body the forces of all bodies behind it.
void DecoupledDynamics::sum_forces() {
  for (std::size_t i = bodies_.size(); i-- > 1;) {
    Body& on = bodies_[std::size_t(bodies_[i].parent)];
    on.force += bodies_[i].force;
    on.torque += bodies_[i].torque;
  }
}

/// Projects forces onto a degree of freedom in which only its own joint moves.
void DecoupledDynamics::project_onto(Dof& dof) const {
  const std::uint32_t body = body_of_link_[dof.link];
  const Body& b = bodies_[body];
  const MovedInertias::Composite& all = tree_.composite(body);
  const Vector &axis = tree_.placed(body).axis, &joint = tree_.placed(body).frame.origin;
  const bool turns = b.joint == JointKind::revolute;
  dof.force = dot(axis, turns ? b.torque - cross(joint, b.force) : b.force);
  dof.inertia = tree_.behind(body);
  if (fixed_base_) return;
  const Vector momentum = turns ? cross(axis, all.first_moment - all.mass * joint) : all.mass * axis;
  dof.inertia -= dot(momentum, momentum) / mass_;
}

/// Projects forces onto a degree of freedom with mimic joints. Call it before forces are summed.
void DecoupledDynamics::project_onto(Dof& dof, std::span<const MovedBody> moved) {
  Vector momentum{0, 0, 0};
  dof.inertia = dof.force = 0;
  for (const MovedBody& m : moved) {
    Body& b = bodies_[m.body];
    const MovedInertias::Placed& p = tree_.placed(m.body);
    b.linear = b.angular = {0, 0, 0};
    if (m.carrier >= 0) {
      const Body& by = bodies_[std::size_t(m.carrier)];
      b.angular = by.angular;
      b.linear = by.linear + cross(by.angular, p.frame.origin - tree_.placed(std::size_t(m.carrier)).frame.origin);
    }
    (b.joint == JointKind::revolute ? b.angular : b.linear) += m.rate * p.axis;
    const Vector velocity = b.linear + cross(b.angular, p.centre - p.frame.origin);
    dof.inertia += b.mass * dot(velocity, velocity) + dot(b.angular, p.tensor * b.angular);
    dof.force += dot(b.force, velocity) + dot(b.torque - cross(p.centre, b.force), b.angular);
    momentum += b.mass * velocity;
  }
  if (!fixed_base_) dof.inertia -= dot(momentum, momentum) / mass_;
}

Wrench DecoupledDynamics::update(const Pose& pose, const Twist& twist, std::span<const double> positions,
                                 const Vec3& gravity) {
  for (Body& b : bodies_) b.force = b.torque = {0, 0, 0};
  if (!all_constant_) find_places(positions);
  const Matrix axes = columns_of(pose.orientation.toRotationMatrix());
  Vector force{0, 0, 0}, torque{0, 0, 0};
  for (const AppliedWrench& w : wrenches_) {
    if (w.wrench.size() == 0) continue;
    const Wrench wrench = w.wrench.value();
    const Vector f = transposed_times(axes, plain(wrench.force)), at = tree_.placed(w.body).frame.at(w.origin);
    const Vector t = transposed_times(axes, plain(wrench.torque)) + cross(at, f);
    Body& b = bodies_[w.body];
    b.force += f, b.torque += t;
    force += f, torque += t;
  }
  add_inertial_forces(force, torque, transposed_times(axes, plain(twist.angular)),
                      transposed_times(axes, plain(gravity)));
  for (std::size_t k = 0; k < dofs_.size(); ++k)
    if (!moved_[k].empty()) project_onto(dofs_[k], moved_[k]);
  sum_forces();
  for (std::size_t k = 0; k < dofs_.size(); ++k)
    if (moved_[k].empty()) project_onto(dofs_[k]);
  return {vector_of(axes * force), vector_of(axes * torque)};
}

}  // namespace muro::simplified
