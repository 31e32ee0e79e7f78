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

void PairContacts::find_forces(std::uint32_t robot) {
  const std::uint32_t group = record(robot).group;
  if (group != no_group) {
    if (groups_[group].robots.front() == robot) solve_group(group);
    return;
  }
  find_springs(robot);
  kernels_.push(known_[robot].points.data(), int(known_[robot].points.size()), context_.stiffness, context_.elapsed);
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

void PairContacts::list_kinematic_robots() const {
  for (const std::uint32_t robot : bodies_.by_order_key) {
    if ((*flags_)[robot] == 0) continue;
    for (const ContactWrench& contact : record(robot).told)
      if (const ListOut<ContactWrench>* list = bodies_.list_of_kinematic(contact.other))
        Bodies::tell_reaction(*list, contact);
  }
}

}  // namespace muro::penalty
