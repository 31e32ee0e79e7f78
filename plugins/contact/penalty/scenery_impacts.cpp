// SPDX-License-Identifier: MIT
// Impacts of robots on scenery.
#include <algorithm>

#include "scenery_contacts.hpp"
#include "spring_batch.hpp"

namespace muro::penalty {

/// Returns a bit for each contact that is an impact; `times`: when, of these contacts.
std::uint32_t SceneryContacts::find_impacts(const StepContext& context, std::uint32_t robot,
                                            TimeOfImpact* times) const {
  static_assert(max_contacts <= 32);
  std::uint32_t which = 0;
  const double step = bodies_.impact_step_of(std::int32_t(robot));
  if (step == 0) return which;
  const auto contacts = *robots_[robot].list;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const FrictionAnchor* const before =
        previous<FrictionAnchor>(*robots_[robot].anchors, k, identities_[robot][k].pair, c.point);
    const auto time = impact_of(context, c, before, bodies_.velocity(c.self, c.point), step, false);
    if (!time) continue;
    times[k] = *time;
    which |= 1u << k;
  }
  return which;
}

/// Impulses in contacts `which`, springs in the others.
void SceneryContacts::process_impacts(const StepContext& context, std::uint32_t robot, std::uint32_t which,
                                      const TimeOfImpact* times) {
  KnownRobot& known = robots_[robot];
  const auto contacts = *known.list;
  const Identities& identities = identities_[robot];
  Contact impacts[max_contacts], others[max_contacts];
  TimeOfImpact impact_times[max_contacts];
  Identities other_identities;
  std::size_t impact_count = 0, other_count = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (which >> k & 1) {
      impact_times[impact_count] = times[k];
      impacts[impact_count++] = contacts[k];
    } else {
      other_identities[other_count] = identities[k];
      others[other_count++] = contacts[k];
    }
  }
  FrictionAnchor of_others[max_contacts];
  bodies_.clear_wrenches(robot);
  if (other_count > 0) {
    const std::span<const Contact> rest(others, other_count);
    apply_springs(context, robot, rest, springs_of(robot, rest, other_identities), of_others);
  }
  known.anchors.clear();
  for (std::size_t k = 0, other = 0; k < contacts.size(); ++k) {
    FrictionAnchor anchor = which >> k & 1 ? anchor_of_impact(0) : of_others[other++];
    anchor.pair = identities[k].pair;
    known.anchors.push_back(anchor);
  }
  known.anchors_match = true;
  note_parting(known);
  apply_impacts(context, robot, {impacts, impact_count}, impact_times);
}

/// Patch by patch, each with the motion that those before it have left: so none gains energy.
void SceneryContacts::apply_impacts(const StepContext& context, std::uint32_t robot, std::span<const Contact> contacts,
                                    const TimeOfImpact* times) const {
  const Robot& r = bodies_.robots[robot];
  const DynamicBody& base = bodies_.base_of(r);
  const FreeBody body(bodies_, base);
  std::uint8_t patch_of[max_contacts];
  const int patches = sort_into_patches(contacts, patch_of);
  *r.impact = {};
  *r.impact_time = context.time;
  Vec3 pushed = Vec3::Zero(), turned = Vec3::Zero();  // by the patches so far
  for (int p = 0; p < patches; ++p) {
    ImpactPoint points[max_contacts];
    std::size_t count = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts[k];
      if (patch_of[k] == p) points[count++] = {context, c, times[k], bodies_.velocity(c.self, c.point), body, nullptr};
    }
    const law::Mobility<double> mobility = body.mobility_before(mean_since({points, count}));
    for (std::size_t k = 0; k < count; ++k) points[k].add_motion(mobility, pushed, turned);
    count =
        std::size_t(std::remove_if(points, points + count, [](const auto& x) { return !(x.approach > 0); }) - points);
    if (count == 0) continue;
    resolve_impact({points, count}, {mobility}, nullptr);
    for (std::size_t k = 0; k < count; ++k) {
      pushed += points[k].impulse;
      turned += points[k].lever.cross(points[k].impulse);
      if (bodies_.tells_contacts) tell_impact(r, points[k], *r.impact_step);
      add_impulse(context, *r.impact_step, points[k], points[k].impulse, body, *base.wrench, *r.impact);
    }
  }
}

}  // namespace muro::penalty
