// SPDX-License-Identifier: MIT
// Impacts of robots with each other and with robots that no force moves.
#include <algorithm>
#include <tuple>

#include "pair_contacts.hpp"

namespace muro::penalty {

/// Records the contact if it is an impact of bodies that move freely. `place`: of the contact among those that the
/// robot computes.
bool PairContacts::add_impact(std::uint32_t self, const Contact& contact, std::int32_t other_robot, std::size_t place) {
  const Robot& robot = bodies_.robots[self];
  const double step = bodies_.impact_step_of(std::int32_t(self));
  const bool falls = other_robot != not_dynamic;
  if (step == 0 || (falls && bodies_.impact_step_of(other_robot) != step)) return false;
  const Vec3 velocity = bodies_.velocity(contact.self, contact.point) - bodies_.velocity(contact.other, contact.point);
  if (!(-velocity.dot(contact.normal) > context_.impact_speed))
    return false;  // most contacts; it saves the search for anchors
  const FrictionAnchor* const before =
      previous<FrictionAnchor>(*robot.anchors, place, bodies_.pair_of(contact), contact.point);
  // A body that does not rebound rests in the step after an impact, whatever falls on it.
  const bool comes_to_rest = contact.surface.restitution * -velocity.dot(contact.normal) < context_.impact_speed;
  if (comes_to_rest && was_in_impact(*robot.anchors, bodies_.pair_of(contact))) return false;
  const auto time = impact_of(context_, contact, before, velocity, step, falls);
  if (!time) return false;
  Record& me = record(self);
  const std::uint32_t model = bodies_[contact.other].model;
  auto patch = std::find_if(me.impact_patches.begin(), me.impact_patches.end(), [&](const ImpactPatch& p) {
    return p.other == other_robot && p.model == model && p.normal.dot(contact.normal) > same_direction;
  });
  if (patch == me.impact_patches.end()) {
    me.impact_patches.push_back({.normal = contact.normal, .other = other_robot, .model = model});
    patch = me.impact_patches.end() - 1;
  }
  const FreeBody body = free_body(self);
  const auto number = std::uint32_t(patch - me.impact_patches.begin());
  if (falls) {
    const FreeBody other = free_body(std::uint32_t(other_robot));
    me.impact_contacts.push_back({number, {context_, contact, *time, velocity, body, &other}});
  } else {
    me.impact_contacts.push_back({number, {context_, contact, *time, velocity, body, nullptr}});
  }
  return true;
}

/// Counts the patches that contain the robot in this step.
void PairContacts::count_impacts(std::uint32_t self) {
  Record& me = record(self);
  me.impacts = me.impact_patches.size();
  for (const std::uint32_t owner : me.owners)
    for (const ImpactPatch& p : record(owner).impact_patches) me.impacts += p.other == std::int32_t(self);
}

/// Resolves each patch with the velocities after the patches before it. So each keeps its energy, except for the part
/// that restitution takes.
void PairContacts::resolve_in_turns() {
  turns_.clear();
  for (const std::uint32_t robot : robots_) {
    Record& me = record(robot);
    me.pushed = {};
    for (std::uint32_t number = 0; number < me.impact_patches.size(); ++number) {
      const std::int32_t other = me.impact_patches[number].other;
      if (me.group == no_group && me.impacts < 2 && (other == not_dynamic || record(std::uint32_t(other)).impacts < 2))
        continue;
      double since = 0;
      for (const ImpactContact& c : me.impact_contacts)
        if (c.patch == number) since = std::max(since, c.point.since);
      turns_.push_back({since, bodies_.robots[robot].order_key, robot, number});
    }
  }
  std::sort(turns_.begin(), turns_.end(), [](const Turn& a, const Turn& b) {
    return std::tuple(-a.since, a.key, a.robot, a.number) < std::tuple(-b.since, b.key, b.robot, b.number);
  });
  for (const Turn& turn : turns_) resolve_in_turn(turn.robot, turn.number);
}

void PairContacts::resolve_in_turn(std::uint32_t self, std::uint32_t number) {
  Record& me = record(self);
  ImpactPatch& patch = me.impact_patches[number];
  patch.is_resolved = true;
  Record* const other_record = patch.other == not_dynamic ? nullptr : &record(std::uint32_t(patch.other));
  me.points.clear();
  for (const ImpactContact& c : me.impact_contacts)
    if (c.patch == number) me.points.push_back(c.point);
  const double since = mean_since(me.points);
  const ImpactBody own{free_body(self).mobility_before(since)};
  std::optional<ImpactBody> other;
  if (other_record) other.emplace(ImpactBody{free_body(std::uint32_t(patch.other)).mobility_before(since)});
  for (ImpactPoint& p : me.points) {
    p.add_motion(own.mobility, me.pushed.force, me.pushed.torque);
    if (other) p.add_motion_of_other(other->mobility, other_record->pushed.force, other_record->pushed.torque);
  }
  std::erase_if(me.points, [](const ImpactPoint& p) { return !(p.approach > 0); });
  if (!me.points.empty()) resolve_impact(me.points, own, other ? &*other : nullptr);
  auto resolved = me.points.begin();
  for (ImpactContact& c : me.impact_contacts) {
    if (c.patch != number || resolved == me.points.end() || resolved->at != c.point.at) continue;
    c.point.impulse = resolved++->impulse;
    me.pushed.add(c.point, c.point.impulse);
    if (!other_record) continue;
    other_record->pushed.force -= c.point.impulse;
    other_record->pushed.torque -= c.point.other_lever.cross(c.point.impulse);
  }
}

/// Applies the impacts that a robot computes.
void PairContacts::apply_impacts(std::uint32_t self) {
  Record& me = record(self);
  if (me.impacts == 0) return;
  const Robot& robot = bodies_.robots[self];
  *robot.impact = {};
  *robot.impact_time = context_.time;
  const FreeBody body = free_body(self);
  for (std::uint32_t number = 0; number < me.impact_patches.size(); ++number) {
    ImpactPatch& patch = me.impact_patches[number];
    me.points.clear();
    for (const ImpactContact& c : me.impact_contacts)
      if (c.patch == number) me.points.push_back(c.point);
    const double since = mean_since(me.points);
    const ImpactBody own{body.mobility_before(since)};
    if (patch.other == not_dynamic) {
      if (!patch.is_resolved) resolve_impact(me.points, own, nullptr);
    } else {
      const FreeBody of_other = free_body(std::uint32_t(patch.other));
      const ImpactBody other{of_other.mobility_before(since)};
      if (!patch.is_resolved) resolve_impact(me.points, own, &other);
      for (const ImpactPoint& p : me.points)
        add_impulse(context_, *robot.impact_step, p, -p.impulse, of_other, patch.reaction, patch.correction);
    }
    Wrench& wrench = *bodies_.base_of(robot).wrench;
    for (const ImpactPoint& p : me.points) {
      if (bodies_.tells_contacts) tell_impact(robot, p, *robot.impact_step);
      add_impulse(context_, *robot.impact_step, p, p.impulse, body, wrench, *robot.impact);
    }
  }
}

/// Adds the reactions of impacts that others compute.
void PairContacts::add_impact_reactions(std::uint32_t self) {
  const Robot& robot = bodies_.robots[self];
  for (const std::uint32_t owner : record(self).owners)
    for (const ImpactPatch& p : record(owner).impact_patches) {
      if (p.other != std::int32_t(self)) continue;
      *bodies_.base_of(robot).wrench += p.reaction;
      *robot.impact += p.correction;
    }
}

}  // namespace muro::penalty
