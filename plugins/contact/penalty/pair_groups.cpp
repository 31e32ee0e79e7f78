// SPDX-License-Identifier: MIT
// Groups of robots that carry each other: their contacts are solved together.
#include <algorithm>
#include <numeric>

#include "pair_contacts.hpp"
#include "vectors.hpp"

namespace muro::penalty {
namespace {

/// Robots whose masses differ by more are solved together.
constexpr double similar_masses = 3;
/// A normal that rises more steeply belongs to a contact that carries: 17 degrees, its sine.
constexpr double rising = 0.3;

/// Whether nothing acts on the robot that is not known here: it is one body, and its motion resolves no contacts.
bool is_resolved_here(const Robot& robot) {
  return robot.is_single_body && contact_algorithm_resolves(*robot.world, kinematic_world);
}

}  // namespace

/// Whether what the contact does hangs on what else its robots carry. Two robots of one body, alike in mass, that touch
/// at their sides do not.
bool PairContacts::carries(std::uint32_t self, const ContactPatch& patch) const {
  if (patch.other == no_robot) return false;
  const Robot &own = bodies_.robots[self], &other = bodies_.robots[std::size_t(patch.other)];
  if (!own.is_single_body || !other.is_single_body) return true;
  if (std::max(own.mass, other.mass) > similar_masses * std::min(own.mass, other.mass)) return true;
  return std::abs(vector_of(patch.patch.normal).dot(context_.gravity)) > rising * context_.gravity.norm();
}

std::uint32_t PairContacts::root_of(std::uint32_t record) {
  while (roots_[record] != record) record = roots_[record] = roots_[roots_[record]];
  return record;
}

/// Robots that touch belong together, as soon as one of them carries another.
void PairContacts::find_groups() {
  const auto count = std::uint32_t(robots_.size());
  roots_.resize(count);
  std::iota(roots_.begin(), roots_.end(), 0u);
  carrying_.assign(count, 0);
  bool any = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    records_[i].group = no_group;
    for (const ContactPatch& p : records_[i].patches) {
      if (p.other == no_robot) continue;
      const std::uint32_t a = root_of(i), b = root_of(record_of_[std::size_t(p.other)]);
      const bool carry = carrying_[a] != 0 || carrying_[b] != 0 || carries(robots_[i], p);
      roots_[std::max(a, b)] = std::min(a, b);
      carrying_[std::min(a, b)] = carry;
      any = any || carry;
    }
  }
  group_count_ = 0;
  if (!any) return;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t root = root_of(i);
    if (!carrying_[root]) continue;
    if (root == i) {
      if (groups_.size() == group_count_) groups_.emplace_back();
      groups_[group_count_].robots.clear();
      records_[i].group = std::uint32_t(group_count_++);
    }
    records_[i].group = records_[root].group;
    groups_[records_[i].group].robots.push_back(robots_[i]);
  }
}

/// All springs of a group have the frequency of contacts under the weight of all its robots, since any contact may have
/// to carry it. Dampers are critical for the same mass.
void PairContacts::solve_group(std::uint32_t number) {
  Group& group = groups_[number];
  group.solver.start(context_.stiffness.h);
  double mass = 0;
  for (const std::uint32_t robot : group.robots) {
    mass += bodies_.robots[robot].mass;
    find_springs(robot);
    add_bodies(robot, group.solver);
  }
  for (const std::uint32_t robot : group.robots) add_contacts(robot, mass, group.solver);
  for (const std::uint32_t robot : group.robots) add_supports(robot, mass, group.solver);
  std::span<const SolverContact> found = group.solver.solve();
  for (const std::uint32_t robot : group.robots) take_forces(robot, found);
}

/// What else than contacts accelerates bodies is their weight, or what follows from their last step. Impacts come
/// first.
void PairContacts::add_bodies(std::uint32_t self, ContactSolver& solver) {
  const Record& me = record(self);
  const Robot& robot = bodies_.robots[self];
  const double h = context_.stiffness.h;
  for (std::uint32_t i = 0; i < robot.body_count; ++i) {
    const Mobility& mobility = me.mobilities[i];
    const DynamicBody& body = bodies_.dynamic_bodies[robot.first_body + i];
    Vec3 velocity = centre_velocity(std::int32_t(self), robot.first_body + i) + h * context_.gravity;
    Vec3 spin = body.twist->angular;
    const auto push = [&](double part, const Vec3& force, const Vec3& torque) {
      velocity += (part * mobility.mass) * force;
      spin += part * vector_of(mobility.inertia * plain(torque));
    };
    if (const LastMotion* const last = last_motion(self, i)) {
      const Push more = what_else_acts(mobility, body, *last);
      push(h, more.force, more.torque);
    }
    if (i == 0 && me.impacts > 0) push(1, me.pushed.force, me.pushed.torque);
    number_in_group_[robot.first_body + i] = solver.add_body(mobility, velocity, spin);
  }
}

/// What the body did in the step before, where it was in a group then and more than its weight may act on it.
const LastMotion* PairContacts::last_motion(std::uint32_t self, std::uint32_t body) const {
  const Robot& robot = bodies_.robots[self];
  if (is_resolved_here(robot)) return nullptr;
  const auto all = *robot.last_motions;
  if (body >= all.size() || context_.elapsed <= 0) return nullptr;
  return std::abs(double(context_.time - all[body].time) * 1e-9 - context_.elapsed) < 1e-9 ? &all[body] : nullptr;
}

/// N, N m about the centre of mass: what must have acted on a body in its last step, beside its weight and contacts of
/// this algorithm. Joints answer to contacts; so it is taken for no more than these were.
Push PairContacts::what_else_acts(const Mobility& mobility, const DynamicBody& body, const LastMotion& last) const {
  const Vec3 arm = vector_of(mobility.centre) - body.pose->position;
  const Vec3 speed_up = (body.twist->at(arm) - last.twist.at(arm)) / context_.elapsed - context_.gravity;
  const Vec3 turn_up = (body.twist->angular - last.twist.angular) / context_.elapsed;
  const Vec3 given = last.wrench.torque - arm.cross(last.wrench.force);
  const law::Symmetric<double>& i = mobility.inertia;
  const Mat3 inverse = (Mat3() << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz).finished();
  Push push;
  push.force = speed_up / mobility.mass - last.wrench.force;
  push.torque = inverse.inverse() * turn_up - given;
  constexpr double most = 1.5;
  const auto limit = [](Vec3& x, double size) {
    if (x.norm() > size) x *= size / x.norm();
  };
  limit(push.force, most * last.wrench.force.norm());
  limit(push.torque, most * given.norm());
  return push;
}

/// For the next step.
void PairContacts::keep_motion(std::uint32_t self) const {
  const Robot& robot = bodies_.robots[self];
  robot.last_motions.clear();
  if (record(self).group == no_group || is_resolved_here(robot)) return;
  for (std::uint32_t u = robot.first_body; u < robot.first_body + robot.body_count; ++u) {
    const DynamicBody& body = bodies_.dynamic_bodies[u];
    robot.last_motions.push_back({context_.time, *body.twist, *body.wrench});
  }
}

void PairContacts::add_contacts(std::uint32_t self, double mass, ContactSolver& solver) {
  constexpr double hardness = 1e4, slower = 0.8;
  const double h = context_.stiffness.h, omega = context_.omega, stiffness = mass * omega * omega;
  const double held = 2 * mass * omega + h * stiffness;
  const Record& me = record(self);
  KnownContacts& known = known_[self];
  const Contact* const contacts = (*bodies_.robots[self].contacts).data();
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    if (!is_solved(c)) continue;
    PairPoint& point = known.points[i];
    const Contact& contact = contacts[c.place];
    const double part = 1 / me.patches[c.patch].patch.count;
    SolverContact& s = solver.add_contact();
    s.body = number_in_group_[c.body];
    s.normal = contact.normal;
    s.lever = contact.point - vector_of(mobility(std::int32_t(self), c.body).centre);
    if (c.other_robot != no_robot) {
      s.other = number_in_group_[c.other_body];
      s.lever += c.lever_shift;
      s.other_lever = contact.point - vector_of(mobility(c.other_robot, c.other_body).centre) + c.other_lever_shift;
    } else {
      s.touched = bodies_.velocity(contact.other, contact.point);
    }
    Vec3::Map(point.displacement) += context_.elapsed * Vec3::Map(point.velocity);
    const Vec3 displacement = Vec3::Map(point.displacement);
    s.along = s.across = part * held;
    s.push =
        std::min(part * stiffness * (contact.depth - point.overlap + point.ahead), s.along * context_.correcting_speed);
    s.spring = part * stiffness * (displacement - contact.normal * contact.normal.dot(displacement));
    s.friction = contact.surface.friction;
    s.limit = s.friction * c.load;
    if (!c.lasts && point.approach > context_.impact_speed)
      c.rebound = contact.surface.restitution * point.approach;
    else
      c.rebound = -point.approach < 0.95 * c.rebound ? slower * c.rebound : 0;
    if (!(c.rebound > 0)) continue;
    s.along = s.across = part * hardness * mass / h;
    s.push = s.along * c.rebound;
    s.spring = Vec3::Zero();
  }
}

/// Contacts with scenery that the robot's own motion resolves: they hold its bodies against what comes down on them.
void PairContacts::add_supports(std::uint32_t self, double mass, ContactSolver& solver) const {
  const Robot& robot = bodies_.robots[self];
  if (contact_algorithm_resolves(*robot.world, kinematic_world)) return;
  constexpr double much = 10, leaves = 0.01;  // m/s
  const double held = much * mass * (2 * context_.omega + context_.stiffness.h * context_.omega * context_.omega);
  for (const Contact& contact : *robot.contacts) {
    const Body& own = bodies_[contact.self];
    if (bodies_.dynamic_robot_of(bodies_[contact.other]) != no_robot || own.robot != std::int32_t(self)) continue;
    const Vec3 touched = bodies_.velocity(contact.other, contact.point);
    if ((bodies_.velocity(contact.self, contact.point) - touched).dot(contact.normal) > leaves) continue;
    SolverContact& s = solver.add_contact();
    s.body = number_in_group_[own.dynamic_body];
    s.normal = contact.normal;
    s.lever = contact.point - vector_of(mobility(std::int32_t(self), own.dynamic_body).centre);
    s.touched = touched;
    s.along = s.across = held;
    s.only_damps = true;
  }
}

void PairContacts::take_forces(std::uint32_t self, std::span<const SolverContact>& found) {
  KnownContacts& known = known_[self];
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    if (!is_solved(c)) continue;
    PairPoint& point = known.points[i];
    const SolverContact& s = found.front();
    c.load = s.load;
    found = found.subspan(1);
    Vec3::Map(point.force) = s.force;
    Vec3 displacement = Vec3::Map(point.displacement);
    displacement -= s.normal * s.normal.dot(displacement);
    if (c.rebound > 0 || !(s.load > 0))
      displacement.setZero();
    else if (s.hold < 1)  // it slides: as far as the spring does what friction does
      displacement = (s.load * s.normal - s.force) * ((2 / context_.omega + context_.stiffness.h) / s.across);
    Vec3::Map(point.displacement) = displacement;
  }
}

}  // namespace muro::penalty
