// SPDX-License-Identifier: MIT
#include "pair_contacts.hpp"

#include <algorithm>
#include <cstring>

#include "overlap.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro::penalty {
std::size_t PairContacts::begin(const StepContext& context, const std::vector<std::uint8_t>& flags) {
  context_ = context;
  flags_ = &flags;
  robots_.clear();
  const std::uint8_t *const begin = flags.data(), *const end = begin + flags.size();
  for (auto at = begin; at != end; ++at) {
    at = static_cast<const std::uint8_t*>(std::memchr(at, 1, std::size_t(end - at)));
    if (!at) break;
    const auto robot = std::uint32_t(at - begin);
    record_of_[robot] = std::uint32_t(robots_.size());
    robots_.push_back(robot);
  }
  if (records_.size() < robots_.size()) add_records();
  return robots_.size();
}

/// Adds records with capacity for the needs of most robots.
void PairContacts::add_records() {
  const std::size_t known = records_.size();
  records_.resize(2 * robots_.size());
  for (auto r = records_.begin() + std::ptrdiff_t(known); r != records_.end(); ++r) {
    r->patches.reserve(12);
    r->owners.reserve(16);
    r->impact_patches.reserve(8);
    r->impact_contacts.reserve(32);
    r->points.reserve(32);
    r->touched.reserve(8);
    if (bodies_.tells_contacts) r->told.reserve(32);
  }
}

void PairContacts::pass(int which, std::uint32_t robot) {
  switch (which) {
    case 0:
      set_up(robot);
      return find_patches(robot);
    case 1:
      find_load(robot);
      return count_impacts(robot);
    case 2: {
      const std::uint32_t group = record(robot).group;
      if (group == no_group) {
        find_springs(robot);
        kernels_.push(known_[robot].points.data(), int(known_[robot].points.size()), context_.stiffness,
                      context_.elapsed);
      } else if (groups_[group].robots.front() == robot) {
        solve_group(group);
      }
      return;
    }
    case 3:
      apply_forces(robot);
      apply_impacts(robot);
      return keep_told(robot);
    case 4:
      return add_reactions(robot);
  }
}

void PairContacts::set_up(std::uint32_t self) {
  const Robot& robot = bodies_.robots[self];
  Record& me = record(self);
  me.first_body = robot.first_body;
  me.mobilities.clear();
  me.springs.assign(robot.body_count, {});
  me.touched.clear();
  me.bounced.clear();
  for (std::uint32_t u = robot.first_body; u < robot.first_body + robot.body_count; ++u) {
    const DynamicBody& body = bodies_.dynamic_bodies[u];
    const Vec3& p = body.pose->position;
    const Quat& q = body.pose->orientation;
    me.mobilities.push_back(
        law::mobility_of(bodies_.masses[body.mass], {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}}));
  }
}

/// Whether robot `self` computes the contact. Both robots of a pair list it, but only one computes it.
bool PairContacts::computes(std::uint32_t self, std::int32_t other) const {
  if (other == not_dynamic) return true;
  const std::uint64_t mine = bodies_.robots[self].order_key, theirs = bodies_.robots[std::size_t(other)].order_key;
  return mine != theirs ? mine < theirs : self < std::uint32_t(other);
}

/// Whether robot `self` computes its contacts with a body. `other_robot`: out, robot of the body, if forces on it
/// count.
bool PairContacts::computes_contacts_with(std::uint32_t self, ObjectId body, std::int32_t& other_robot) {
  other_robot = bodies_.dynamic_robot_of(bodies_[body]);
  if (!contact_algorithm_resolves(*bodies_.robots[self].world, bodies_.world_of(other_robot))) return false;
  // Nothing is computed for robots that list nothing: a shadow's partner, and one handed over after the collision step.
  const bool takes_part = other_robot != not_dynamic && (*flags_)[std::size_t(other_robot)] != 0;
  if (bodies_.robots[self].is_shadow || !takes_part) other_robot = not_dynamic;
  if (computes(self, other_robot)) return true;
  std::vector<std::uint32_t>& owners = record(self).owners;
  const auto owner = std::uint32_t(other_robot);
  if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  return false;
}

/// Finds the runs of the present list.
void PairContacts::find_runs(std::uint32_t self) {
  KnownContacts& known = known_[self];
  const Robot& robot = bodies_.robots[self];
  const auto contacts = *robot.contacts;
  if (known.count == contacts.size() && known.revision == robot.contacts.revision()) return;
  known.count = contacts.size();
  known.revision = robot.contacts.revision();
  known.resist_turning = false;
  known.computed.clear();
  known.points.clear();
  known.runs.clear();
  for (std::uint32_t k = 0; k < contacts.size(); ++k) {
    if (known.runs.empty() || known.runs.back().other != contacts[k].other)
      known.runs.push_back({.other = contacts[k].other, .end = k});
    known.runs.back().end = k + 1;
    const Surface& surface = contacts[k].surface;
    known.resist_turning = known.resist_turning || surface.rolling_resistance > 0 || surface.spinning_resistance > 0;
  }
}

/// Finds the contacts to compute, from the present runs.
void PairContacts::find_computed(std::uint32_t self) {
  static constexpr double at_rest[6] = {};
  KnownContacts& known = known_[self];
  known.computed.clear();
  known.points.clear();
  std::uint32_t k = 0;
  const auto contacts = *bodies_.robots[self].contacts;
  for (const Run& run : known.runs) {
    for (; k < run.end; ++k) {
      if (!run.is_computed) continue;
      const Contact& contact = contacts[k];
      const Body &own = bodies_[contact.self], &other = bodies_[contact.other];
      known.computed.push_back(
          {.pair = bodies_.pair_of(contact),
           .place = k,
           .body = own.dynamic_body,
           .other_body = other.dynamic_body,
           .model = other.model,
           .other_robot = run.other_robot,
           .zeta = bodies_.materials[bodies_.material_of(contact.surface.restitution)].damping_ratio,
           .is_of_disc = bodies_.is_of_disc(contact)});
      PairPoint& p = known.points.emplace_back();
      p.pose = own.twist ? own.pose->position.data() : at_rest;
      p.twist = own.twist ? own.twist->linear.data() : at_rest;
      p.other_pose = other.twist ? other.pose->position.data() : at_rest;
      p.other_twist = other.twist ? other.twist->linear.data() : at_rest;
    }
  }
}

/// Finds which contacts the robot computes in this step, and how they move.
void PairContacts::update_computed(std::uint32_t self) {
  KnownContacts& known = known_[self];
  find_runs(self);
  const double lag = *bodies_.robots[self].lag;
  bool is_same = !known.computed.empty(), has_lag = lag != 0;
  for (Run& run : known.runs) {
    std::int32_t other_robot = not_dynamic;
    const bool is_computed = computes_contacts_with(self, run.other, other_robot);
    is_same = is_same && is_computed == run.is_computed && other_robot == run.other_robot;
    run.is_computed = is_computed;
    run.other_robot = other_robot;
    has_lag = has_lag || (other_robot != not_dynamic && *bodies_.robots[std::size_t(other_robot)].lag != 0);
  }
  if (!is_same) find_computed(self);
  const Contact* const contacts = (*bodies_.robots[self].contacts).data();
  for (std::size_t i = 0; i < known.points.size(); ++i) {
    const Computed& c = known.computed[i];
    PairPoint& p = known.points[i];
    p.contact = contacts[c.place].point.data();
    if (!has_lag) continue;
    p.lag = lag;
    p.other_lag = c.other_robot == not_dynamic ? 0 : *bodies_.robots[std::size_t(c.other_robot)].lag;
  }
  find_cells(known);
  kernels_.move(known.points.data(), int(known.points.size()), context_.stiffness.h, has_lag);
}

/// Finds the cells of lines and faces.
void PairContacts::find_cells(KnownContacts& known) {
  const auto normal = [&](std::size_t i) { return Vec3(Vec3::Map(known.points[i].contact + 3)); };
  const auto belongs = [&](std::size_t first, std::size_t i) {
    return known.computed[i].pair == known.computed[first].pair && normal(first).dot(normal(i)) > same_direction;
  };
  contact_geometry::each_patch(known.computed.size(), belongs, [&](std::size_t begin, std::size_t end) {
    std::fill_n(known.points[begin].turn, 3, 0.0);
    contact_geometry::find_cells(
        end - begin, known.computed[begin].is_of_disc, [&](std::size_t i) { return known.points[begin + i].contact; },
        [&](std::size_t i, const Vec3& cell) {
          Vec3::Map(known.points[begin + i].turn) = normal(begin + i).cross(cell);
        });
  });
}

/// Sorts the contacts of a robot into patches.
void PairContacts::find_patches(std::uint32_t self) {
  Record& me = record(self);
  me.patches.clear();
  me.owners.clear();
  me.impact_patches.clear();
  me.impact_contacts.clear();
  update_computed(self);
  KnownContacts& known = known_[self];
  const auto contacts = *bodies_.robots[self].contacts;
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    const Contact& contact = contacts[c.place];
    const bool is_impact =
        known.points[i].approach > context_.impact_speed && add_impact(self, contact, c.other_robot, i);
    c.patch = is_impact ? in_impact : add_to_patch(me, c, contact);
  }
  std::sort(me.owners.begin(), me.owners.end(),
            [this](std::uint32_t a, std::uint32_t b) { return computes(a, std::int32_t(b)); });
}

/// Adds a contact to its patch. Returns the number of the patch.
std::uint32_t PairContacts::add_to_patch(Record& me, const Computed& c, const Contact& contact) const {
  const V3 normal = plain(contact.normal);
  auto found = std::find_if(me.patches.begin(), me.patches.end(), [&](const ContactPatch& p) {
    return p.body == c.body && p.model == c.model && (c.other_robot == not_dynamic || p.other_body == c.other_body) &&
           dot(p.patch.normal, normal) > same_direction;
  });
  if (found == me.patches.end()) {
    const Patch patch(normal, me.mobilities[c.body - me.first_body].centre);
    me.patches.push_back(
        {.patch = patch, .body = c.body, .other = c.other_robot, .other_body = c.other_body, .model = c.model});
    found = me.patches.end() - 1;
  }
  found->patch.add(plain(contact.point));
  return std::uint32_t(found - me.patches.begin());
}

/// Returns the effective mass of a patch, divided among its points.
law::EffectiveMass<double> PairContacts::effective_mass_of(const Mobility& self, const ContactPatch& p) const {
  const law::InverseEffectiveMass<double> middle = p.patch.at_middle(self);
  if (p.other == not_dynamic) return {middle, p.patch.count};
  const Mobility& other = mobility(p.other, p.other_body);
  return {middle + p.patch.seen_from(other.centre).at_middle(other), p.patch.count};
}

/// Adds up the springs of all patches of a robot, its own and those that others compute. The load of several
/// dynamic bodies is at most the sum of theirs.
void PairContacts::find_load(std::uint32_t self) {
  Record& me = record(self);
  for (ContactPatch& p : me.patches) {
    const std::uint32_t body = p.body - me.first_body;
    p.effective_mass = effective_mass_of(me.mobilities[body], p);
    me.springs[body] += p.patch.stiffness(p.effective_mass.along, p.effective_mass.across);
  }
  for (const std::uint32_t owner : me.owners)
    for (const ContactPatch& p : record(owner).patches)
      if (p.other == std::int32_t(self)) {
        const law::EffectiveMass<double> mass = effective_mass_of(mobility(std::int32_t(owner), p.body), p);
        const std::uint32_t body = p.other_body - me.first_body;
        me.springs[body] += p.patch.seen_from(me.mobilities[body].centre).stiffness(mass.along, mass.across);
      }
  me.load = me.springs[0].max_eigenvalue_bound(me.mobilities[0]);
  for (std::size_t u = 1; u < me.springs.size(); ++u) me.load += me.springs[u].max_eigenvalue_bound(me.mobilities[u]);
}

/// Recalls what the contacts that a robot computes have kept from the step before.
void PairContacts::find_springs(std::uint32_t self) {
  static constexpr double no_patch[4] = {};
  Record& me = record(self);
  KnownContacts& known = known_[self];
  const std::span<const FrictionAnchor> old = *bodies_.robots[self].anchors;
  const bool any_impacts = std::any_of(old.begin(), old.end(), is_of_impact);
  const Contact* const contacts = (*bodies_.robots[self].contacts).data();
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    Computed& c = known.computed[i];
    PairPoint& point = known.points[i];
    const Contact& contact = contacts[c.place];
    const FrictionAnchor* const before = previous(old, i, c.pair, contact.point);
    c.lasts = before != nullptr;
    Vec3::Map(point.displacement) = before ? before->displacement : Vec3::Zero();
    point.overlap = 0;
    point.zeta = c.zeta;
    point.patch = no_patch;
    if (c.patch == in_impact) continue;
    if (any_impacts && point.approach < -context_.impact_speed && was_in_impact(old, c.pair)) {  // the bodies part
      c.patch = had_impact;
      continue;
    }
    ContactPatch& patch = me.patches[c.patch];
    if (!patch.has_load) set_load(self, patch);
    point.patch = &patch.effective_mass.along;
    const AnchorDetail detail = before ? bodies_.robots[self].anchors.detail_of(*before) : AnchorDetail{};
    point.overlap = unmoved_overlap(context_, contact, before ? &detail : nullptr, point.approach);
    find_lever_shifts(self, patch, contact.point, before, detail, c);
  }
}

/// Applies the forces of the contacts that a robot computes.
void PairContacts::apply_forces(std::uint32_t self) {
  Record& me = record(self);
  KnownContacts& known = known_[self];
  const Robot& robot = bodies_.robots[self];
  robot.anchors.clear();
  if (!(*robot.solved).empty()) robot.solved.clear();
  if (robot.turning_springs) {
    const auto springs = *robot.turning_springs;
    me.old_turning_springs.assign(springs.begin(), springs.end());
    robot.turning_springs.clear();
  }
  bodies_.clear_wrenches(self);
  const Contact* const contacts = (*robot.contacts).data();
  for (std::size_t i = 0; i < known.computed.size(); ++i) {
    const Computed& c = known.computed[i];
    const PairPoint& point = known.points[i];
    const Contact& contact = contacts[c.place];
    ContactWrench* const told =
        bodies_.tells_contacts && c.patch != in_impact ? Bodies::tell(robot, {&contact, 1}) : nullptr;
    if (c.patch == in_impact || c.patch == had_impact) {
      robot.anchors.push_back(anchor_of_impact(c.pair));
      continue;
    }
    robot.anchors.push_back({c.pair, contact.point, Vec3::Map(point.displacement)}, {point.overlap, c.way});
    if (me.group != no_group) robot.solved.push_back(c.solved);
    const Vec3 force = Vec3::Map(point.force);
    ContactPatch& patch = me.patches[c.patch];
    const Vec3 moment = point.moment * contact.normal;
    if (patch.other != not_dynamic) {
      apply_to_pair(c, patch, force, moment, contact.point);
    } else {
      Wrench& wrench = *bodies_.dynamic_bodies[patch.body].wrench;
      wrench.add_force(force, contact.point - bodies_.dynamic_bodies[patch.body].pose->position);
      wrench.torque += c.lever_shift.cross(force);
      wrench.torque += moment;
    }
    if (told) told->wrench = {force, moment};
    if (!known.resist_turning) continue;
    if (contact.surface.rolling_resistance > 0 || contact.surface.spinning_resistance > 0) {
      const TurningSpring* const spring =
          previous<TurningSpring>(me.old_turning_springs, (*robot.turning_springs).size(), c.pair, contact.point);
      const Vec3 torque =
          resist_turning(self, patch, contact, {c.pair, contact.point, spring ? spring->angle : Vec3::Zero()},
                         force.dot(contact.normal));
      if (told) told->wrench.torque += torque;
    }
  }
}

/// Applies rolling and spinning resistance. Returns the torque. `spring`: its state after the last step.
Vec3 PairContacts::resist_turning(std::uint32_t self, ContactPatch& patch, const Contact& contact,
                                  const TurningSpring& spring, double normal_force) {
  const Robot& robot = bodies_.robots[self];
  const auto rate_of = [&](ObjectId id) {
    const Body& body = bodies_[id];
    return body.twist ? body.twist->angular : Vec3::Zero();
  };
  double inverse_inertia = largest_eigenvalue_bound(mobility(std::int32_t(self), patch.body).inertia);
  double load = record(self).load + double(record(self).patches.size());
  if (patch.other != not_dynamic) {
    inverse_inertia += largest_eigenvalue_bound(mobility(patch.other, patch.other_body).inertia);
    load += record(std::uint32_t(patch.other)).load;
  }
  const Vec3 turning = rate_of(contact.self) - rate_of(contact.other);
  TurningSpring turned = spring;
  turned.angle += turning * context_.elapsed;
  const Vec3 torque =
      turning_resistance(turned, law::FrictionLaw<double>(context_.stiffness, load), contact.surface, contact.normal,
                         turning, normal_force, 1 / (inverse_inertia * patch.patch.count));
  robot.turning_springs.push_back(turned);
  bodies_.dynamic_bodies[patch.body].wrench->torque += torque;
  if (patch.other != not_dynamic) patch.reaction.torque -= torque;
  return torque;
}

void PairContacts::set_load(std::uint32_t self, ContactPatch& p) const {
  p.has_load = true;
  p.load = record(self).load + (p.other == not_dynamic ? 0 : record(std::uint32_t(p.other)).load);
  if (p.other == not_dynamic) return;
  p.velocity = centre_velocity(std::int32_t(self), p.body);
  p.other_velocity = centre_velocity(p.other, p.other_body);
}

Vec3 PairContacts::centre_velocity(std::int32_t robot, std::uint32_t body) const {
  const DynamicBody& u = bodies_.dynamic_bodies[body];
  return u.twist->at(vector_of(mobility(robot, body).centre) - u.pose->position);
}

/// Applies the force of a contact to both robots.
void PairContacts::apply_to_pair(const Computed& c, ContactPatch& patch, const Vec3& force, const Vec3& moment,
                                 const Vec3& point) const {
  const DynamicBody& own = bodies_.dynamic_bodies[patch.body];
  const DynamicBody& other = bodies_.dynamic_bodies[patch.other_body];
  own.wrench->add_force(force, point - own.pose->position);
  own.wrench->torque += moment + c.lever_shift.cross(force);
  patch.reaction.add_force(-force, point - other.pose->position);
  patch.reaction.torque -= moment + c.other_lever_shift.cross(force);
}

/// Copies the reported contacts. In the next pass, others read the copy while the list gets contacts computed by
/// others.
void PairContacts::keep_told(std::uint32_t self) {
  if (!bodies_.tells_contacts) return;
  std::vector<ContactWrench>& told = record(self).told;
  told.clear();
  if (bodies_.robots[self].is_shadow) return;
  for (const ContactWrench& contact : *bodies_.robots[self].told)
    if (bodies_[contact.other].twist) told.push_back(contact);
}

void PairContacts::add_reactions(std::uint32_t self) {
  for (const std::uint32_t owner : record(self).owners) {
    for (const ContactPatch& p : record(owner).patches)
      if (p.other == std::int32_t(self)) *bodies_.dynamic_bodies[p.other_body].wrench += p.reaction;
    if (!bodies_.tells_contacts) continue;
    for (const ContactWrench& contact : record(owner).told)
      if (bodies_[contact.other].robot == std::int32_t(self)) Bodies::tell_reaction(bodies_.robots[self].told, contact);
  }
  if (record(self).impacts > 0) add_impact_reactions(self);
}

void PairContacts::tell_kinematic_robots() const {
  for (const std::uint32_t robot : bodies_.by_order_key) {
    if ((*flags_)[robot] == 0) continue;
    for (const ContactWrench& contact : record(robot).told)
      if (const ListOut<ContactWrench>* list = bodies_.list_of_kinematic(contact.other))
        Bodies::tell_reaction(*list, contact);
  }
}

}  // namespace muro::penalty
