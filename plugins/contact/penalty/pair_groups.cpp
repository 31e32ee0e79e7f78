// SPDX-License-Identifier: MIT
// Groups of robots that carry each other: their contacts are solved together.
#include <algorithm>
#include <numeric>

#include "muro/base/number_text.hpp"
#include "pair_contacts.hpp"
#include "plugins/common/contact_geometry/contact_load.hpp"
#include "plugins/common/lanes/vectors.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::penalty {
namespace {

using contact_geometry::load_mean_over, contact_geometry::most_weights, contact_geometry::standard_gravity;

/// Robots are solved together if the ratio of their masses is larger.
constexpr double similar_masses = 3;
/// Sine of 17 degrees. A normal that rises more steeply belongs to a contact that carries.
constexpr double rising = 0.3;

/// Whether the motion of the robot leaves its contacts with scenery to this algorithm.
bool is_resolved_here(const Robot& robot) { return contact_algorithm_resolves(*robot.world, kinematic_world); }

/// Whether all that acts on the robot is known here, except external wrenches: it is one body, and all its contacts are
/// in its list.
bool is_known(const Robot& robot) { return robot.is_single_body && (robot.carried_mass || is_resolved_here(robot)); }

/// Whether its joints move as if the others were locked, so that a force on one link does not move another, as in
/// motion.simplified.
bool is_decoupled(const Robot& robot) { return !robot.is_single_body && is_resolved_here(robot); }

}  // namespace

/// Whether the force of the contact depends on what else its robots carry. This is not so for two robots of one body,
/// of similar mass, that touch at their sides.
bool PairContacts::carries(std::uint32_t self, const ContactPatch& patch) const {
  if (patch.other == not_dynamic) return false;
  const Robot &own = bodies_.robots[self], &other = bodies_.robots[std::size_t(patch.other)];
  if (!own.is_single_body || !other.is_single_body) return true;
  if (std::max(own.mass, other.mass) > similar_masses * std::min(own.mass, other.mass)) return true;
  return std::abs(vector_of(patch.patch.normal).dot(context_.gravity)) > rising * context_.gravity.norm();
}

std::uint32_t PairContacts::root_of(std::uint32_t record) {
  while (roots_[record] != record) record = roots_[record] = roots_[roots_[record]];
  return record;
}

/// Forms groups. Robots that touch belong together, as soon as one of them carries another.
void PairContacts::find_groups() {
  const auto count = std::uint32_t(robots_.size());
  roots_.resize(count);
  std::iota(roots_.begin(), roots_.end(), 0u);
  carrying_.assign(count, 0);
  bool any = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    records_[i].group = no_group;
    if (bodies_.is_solved_alone(context_, robots_[i])) carrying_[root_of(i)] = 1, any = true;
    for (const ContactPatch& p : records_[i].patches) {
      if (p.other == not_dynamic) continue;
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
  // so sums do not depend on the order of declaration
  for (std::size_t g = 0; g < group_count_; ++g) bodies_.sort_by_order_key(groups_[g].robots);
}

/// All springs of a group have the frequency of contacts under the weight of all its robots, since any contact may have
/// to carry it. In a pile no contact carries all: the weight is at most `most_carried` times that of the heaviest
/// robot. Dampers are critical for the same mass.
void PairContacts::solve_group(std::uint32_t number) {
  Group& group = groups_[number];
  group.solver.start(context_.stiffness.h);
  constexpr double most_carried = 16;
  double mass = 0, heaviest = 0;
  for (const std::uint32_t robot : group.robots) {
    mass += bodies_.robots[robot].mass;
    heaviest = std::max(heaviest, bodies_.robots[robot].mass);
    find_springs(robot);
    recall_contacts(robot);
  }
  for (const std::uint32_t robot : group.robots) find_touched(robot);
  mass = std::min(mass, most_carried * heaviest);
  for (const std::uint32_t robot : group.robots) add_bodies(robot, group.solver);
  for (const std::uint32_t robot : group.robots)
    if (const Out<double>& carried = bodies_.robots[robot].carried_mass) *carried = mass;
  for (const std::uint32_t robot : group.robots) add_contacts(robot, mass, group.solver);
  for (const std::uint32_t robot : group.robots) add_supports(robot, mass, group.solver);
  std::span<const SolverContact> found = group.solver.solve();
  for (const std::uint32_t robot : group.robots) take_forces(robot, found);
}

/// Records which bodies have contacts that a robot computes.
void PairContacts::find_touched(std::uint32_t self) {
  for (const Computed& c : known_[self].computed) {
    if (!is_solved(c)) continue;
    record(self).add_touched(c.body);
    if (c.other_robot != not_dynamic) record(std::uint32_t(c.other_robot)).add_touched(c.other_body);
  }
}

/// Adds the bodies of a robot. Besides contacts, only their weight accelerates them. Impacts come first.
void PairContacts::add_bodies(std::uint32_t self, ContactSolver& solver) {
  Record& me = record(self);
  const Robot& robot = bodies_.robots[self];
  std::sort(me.touched.begin(), me.touched.end());
  const bool is_apart = robot.is_single_body || is_decoupled(robot);
  const double shared = me.shared = is_apart ? 1 : bodies_.apparent_masses[self].shared_by(me.touched);
  for (std::uint32_t i = 0; i < robot.body_count; ++i) {
    if (!robot.carried_mass && std::find(me.touched.begin(), me.touched.end(), i) == me.touched.end()) continue;
    Mobility mobility = me.mobilities[i];
    mobility.mass *= shared;
    mobility.inertia = shared * mobility.inertia;
    const Vec3 velocity = centre_velocity(std::int32_t(self), robot.first_body + i);
    const Vec3 spin = bodies_.dynamic_bodies[robot.first_body + i].twist->angular;
    Vec3 gained = context_.stiffness.h * context_.gravity, turned = Vec3::Zero();
    if (i == 0 && me.impacts > 0) {
      gained += mobility.mass * me.pushed.force;
      turned = vector_of(mobility.inertia * plain(me.pushed.torque));
    }
    const law::V3<double>* const bounced = me.bounced.empty() ? nullptr : &me.bounced[2 * i];
    if (bounced) {
      const Vec3 impulse = vector_of(bounced[0]);
      gained += mobility.mass * impulse;
      turned += vector_of(mobility.inertia * (bounced[1] - cross(mobility.centre, bounced[0])));
    }
    number_in_group_[robot.first_body + i] = solver.add_body(mobility, velocity, spin, gained, turned);
  }
}

/// Returns the time (s) over which it is learnt how links move otherwise than they seem to. A base that legs carry is
/// many times as heavy as a foot seems, and follows it later. With longer steps, a foot bears less that is not learnt.
double PairContacts::mean_over_of(std::uint32_t self) const {
  constexpr double least = 0.3, short_step = 1e-3;  // s
  const Robot& robot = bodies_.robots[self];
  const Twist& base = *bodies_.base_of(robot).twist;
  const bool is_free = !base.linear.isZero(0) || !base.angular.isZero(0);
  const double steps = context_.stiffness.h / short_step;
  return is_decoupled(robot) && is_free ? least * std::max(1.0, steps * steps) : least;
}

/// Recalls what is kept of a contact. Bodies with joints, and those of engines, are not as heavy as they seem, and more
/// than their weight acts on them. So contacts part faster or more slowly than expected. The mean of this difference is
/// learnt, so that it does not change how deep a contact is at rest.
void PairContacts::recall(std::uint32_t self, std::size_t place, Computed& c, double approach, const Contact& contact,
                          double mean_over) const {
  const Robot& robot = bodies_.robots[self];
  const SolvedContact* const before = previous<SolvedContact>(*robot.solved, place, c.pair, contact.point);
  c.solved = before ? *before : SolvedContact{};
  SolvedContact& now = c.solved;
  now.pair = c.pair, now.point = contact.point;
  now.rebounds = std::max(0.0, now.rebounds - context_.elapsed);
  // three quarters of a period of its spring
  if (!c.lasts && approach > context_.impact_speed && c.zeta < max_damping_ratio)
    now.rebounds = 1.5 * M_PI / context_.stiffness.omega;
  const bool is_exact = c.is_exact =
      is_known(robot) && (c.other_robot == not_dynamic || is_known(bodies_.robots[std::size_t(c.other_robot)]));
  if (is_exact || !before || !(now.load > 0)) {
    now.more = 0;
    return;
  }
  now.more += std::min(1.0, context_.elapsed / mean_over) * (-approach - now.expected - now.more);
}

/// Recalls all contacts that a robot computes. Those that bounce are single springs, and known when the others are
/// solved.
void PairContacts::recall_contacts(std::uint32_t self) {
  KnownContacts& known = known_[self];
  const double mean_over = mean_over_of(self);
  const Contact* const contacts = (*bodies_.robots[self].contacts).data();
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    c.solved.rebounds = 0;
    if (!is_solved(c)) continue;
    PairPoint& point = known.points[i];
    recall(self, i, c, point.approach, contacts[c.place], mean_over);
    if (is_solved(c)) continue;
    kernels_.push(&point, 1, context_.stiffness, context_.elapsed);
    c.solved.load = 0;
    const Vec3 impulse = context_.stiffness.h * Vec3::Map(point.force);
    record(self).add_impulse(c.body, impulse, contacts[c.place].point);
    if (c.other_robot != not_dynamic)
      record(std::uint32_t(c.other_robot)).add_impulse(c.other_body, -impulse, contacts[c.place].point);
  }
}

bool PairContacts::has_joints(std::int64_t robot) const {
  return robot != not_dynamic && !bodies_.robots[std::size_t(robot)].is_single_body;
}

/// Returns the mass (kg) that links and bodies seem to have across the normal, for a point of the patch.
double PairContacts::apparent_mass_across(std::uint32_t self, const Computed& c) const {
  const double other = c.other_robot == not_dynamic ? 1 : record(std::uint32_t(c.other_robot)).shared;
  return record(self).patches[c.patch].effective_mass.across / std::max(record(self).shared, other);
}

/// Returns the depth (m) whose spring acts, if all that acts on the bodies is known.
double PairContacts::parted_depth(double depth) const {
  const double omega = context_.omega;
  return contact_geometry::parted_depth(depth, 2 * context_.correcting_speed / omega,
                                        2 * standard_gravity / (omega * omega));
}

/// Adds contacts. Joints may hold a link, so that friction does not move it. If the solver let the link give way, a
/// held load would creep. So the velocity of links across the normal stays as it is. The spring there is that of the
/// mass that links seem to have, which is stable if nothing holds them.
void PairContacts::add_contacts(std::uint32_t self, double mass, ContactSolver& solver) {
  const double omega = context_.omega;
  const Record& me = record(self);
  const law::FrictionLaw<double> friction(context_.stiffness, me.load);
  const bool is_own_decoupled = is_decoupled(bodies_.robots[self]);
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
    if (c.other_robot != not_dynamic) {
      s.other = number_in_group_[c.other_body];
      s.lever += c.lever_shift;
      s.other_lever = contact.point - vector_of(mobility(c.other_robot, c.other_body).centre) + c.other_lever_shift;
    } else {
      s.lever += c.lever_shift;
      s.touched = bodies_.velocity(contact.other, contact.point);
    }
    const Vec3 turn = Vec3::Map(point.turn), of_spin = point.spin * turn;
    s.cell = turn.cross(contact.normal);
    if (c.other_robot == not_dynamic) {
      const Vec3 of_cell = bodies_.velocity(contact.other, contact.point + s.cell) - s.touched;
      s.touched += of_cell - contact.normal * contact.normal.dot(of_cell);
    }
    Vec3::Map(point.displacement) += context_.elapsed * (Vec3::Map(point.velocity) + of_spin);
    const Vec3 displacement = Vec3::Map(point.displacement);
    const bool holds_own = has_joints(self), holds_other = has_joints(c.other_robot),
               is_pressed = holds_own || holds_other;
    // a body that moves on its own presses as hard as its contact is stiff, and a stiffer contact would be pressed
    // harder
    const bool learns = is_pressed && (c.other_robot != not_dynamic || !bodies_.moves(contact.other));
    const double pressed = learns ? std::min(c.solved.mean_load / standard_gravity, most_weights * mass) : 0;
    const double carried = std::max(part * mass, pressed);
    const double stiffness = carried * omega * omega, held = 2 * carried * omega + context_.stiffness.h * stiffness;
    s.along = held;
    const double depth = contact.depth - point.overlap + point.ahead;
    s.push = stiffness * (c.is_exact ? parted_depth(depth) : depth);
    s.push = std::min(s.push, s.along * context_.correcting_speed);
    if (is_pressed) solver.hold(holds_own, holds_other);
    const Vec3 tangential = displacement - contact.normal * contact.normal.dot(displacement);
    if (is_own_decoupled && c.other_robot == not_dynamic) {
      const double mass_across = apparent_mass_across(self, c);
      s.across = mass_across * friction.held;
      s.spring = mass_across * friction.spring * tangential;
    } else {
      const double mass_across = is_pressed ? apparent_mass_across(self, c) : carried;
      s.across = mass_across / carried * held;
      s.spring = mass_across * omega * omega * tangential;
    }
    s.friction = contact.surface.friction;
    s.limit = s.friction * c.solved.load;
    s.push -= s.along * c.solved.more;
    const double ends = law::speed_of_ends(plain(of_spin));
    c.yield = ends > 0 && s.limit > 0 ? ends / s.limit : 0;
    const double rest =
        1 / (1 + c.yield * s.across);  // of a spring and damper in series with one that gives way, see FrictionLaw
    s.across *= rest;
    s.spring *= rest;
  }
}

/// Adds contacts with scenery that the robot's own motion resolves, since they hold its bodies against loads from
/// above: contacts of one body as springs, those of bodies with joints, which react to loads, as dampers.
void PairContacts::add_supports(std::uint32_t self, double mass, ContactSolver& solver) const {
  const Robot& robot = bodies_.robots[self];
  if (!robot.carried_mass || is_resolved_here(robot)) return;
  constexpr double much = 10, leaves = 0.01;  // m/s
  const double stiffness = mass * context_.omega * context_.omega;
  const double held = 2 * mass * context_.omega + context_.stiffness.h * stiffness;
  for (const Contact& contact : *robot.contacts) {
    const Body& own = bodies_[contact.self];
    if (bodies_.dynamic_robot_of(bodies_[contact.other]) != not_dynamic || own.robot != std::int32_t(self)) continue;
    const Vec3 touched = bodies_.velocity(contact.other, contact.point);
    if ((bodies_.velocity(contact.self, contact.point) - touched).dot(contact.normal) > leaves) continue;
    SolverContact& s = solver.add_contact();
    s.body = number_in_group_[own.dynamic_body];
    s.normal = contact.normal;
    s.lever = contact.point - vector_of(mobility(std::int32_t(self), own.dynamic_body).centre);
    s.touched = touched;
    s.only_damps = !robot.is_single_body;
    s.along = s.across = s.only_damps ? much * held : held;
    if (s.only_damps) continue;
    s.push = stiffness * parted_depth(contact.depth);
    s.friction = contact.surface.friction;
    s.limit = s.friction * s.push;
  }
}

/// Reports once that a contact rests deeper than contacts should. If engines hold a body, this algorithm does not know
/// what holds it.
void PairContacts::tell_depth(std::uint32_t self, const Contact& contact, const PairPoint& point, const Computed& c) {
  constexpr double too_deep = 2e-3, at_rest = 1e-3;  // m, m/s
  if (contact.depth - point.overlap < too_deep || std::abs(point.approach) > at_rest || !c.lasts) return;
  if (c.other_robot == not_dynamic) return;
  if (is_known(bodies_.robots[self]) && is_known(bodies_.robots[std::size_t(c.other_robot)])) return;
  if (depth_is_told_.exchange(true)) return;
  const auto name = [&](ObjectId id) { return quote(bodies_.names[index_of(id)]); };
  host_.log(LogLevel::warning, "contact.penalty: " + name(contact.self) + " is pressed " +
                                   number_text(1e3 * contact.depth) + " mm deep into " + name(contact.other) +
                                   ": what holds them is hidden in their motions; move both by one motion, or what " +
                                   "is pressed by motion.simplified or motion.articulated (told once)");
}

void PairContacts::take_forces(std::uint32_t self, std::span<const SolverContact>& found) {
  KnownContacts& known = known_[self];
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    if (!is_solved(c)) continue;
    PairPoint& point = known.points[i];
    const SolverContact& s = found.front();
    tell_depth(self, (*bodies_.robots[self].contacts)[c.place], point, c);
    c.solved.load = s.load;
    c.solved.expected = s.away;
    if (c.lasts)
      c.solved.mean_load += std::min(1.0, context_.stiffness.h / load_mean_over) * (s.load - c.solved.mean_load);
    found = found.subspan(1);
    Vec3::Map(point.force) = s.force;
    point.moment = s.force.dot(Vec3::Map(point.turn));
    const Vec3 friction = s.force - s.load * s.normal;
    Vec3 displacement = Vec3::Map(point.displacement);
    displacement -= s.normal * s.normal.dot(displacement);
    displacement += (context_.stiffness.h * c.yield) * friction;
    if (!(s.load > 0))
      displacement.setZero();
    else if (s.hold < 1)  // it slides: the spring has the force of friction at this displacement
      displacement = -friction * ((2 / context_.omega + context_.stiffness.h) * (1 / s.across - c.yield));
    Vec3::Map(point.displacement) = displacement;
  }
}

}  // namespace muro::penalty
