// SPDX-License-Identifier: MIT
// Impacts of robots on scenery.
#include <algorithm>

#include "scenery_contacts.hpp"

namespace muro::penalty {
namespace {

/// Numbers contacts by patch: contacts with one object of the scenery and similar normals. Returns the number of
/// patches.
int sort_into_patches(const Bodies& bodies, std::span<const Contact> contacts, std::uint8_t* patch_of) {
  std::size_t first[max_contacts];  // contact of each patch
  int patches = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    int p = patches - 1;
    while (p >= 0 && !(bodies[c.other].model == bodies[contacts[first[p]].other].model &&
                       contacts[first[p]].normal.dot(c.normal) > same_direction))
      --p;
    if (p < 0) first[p = patches++] = k;
    patch_of[k] = std::uint8_t(p);
  }
  return patches;
}

}  // namespace

/// Returns a bit for each contact that is an impact; `times`: out, the times of these impacts.
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

/// Applies the impacts of contacts `which`, patch by patch, each with the motion after the patches before it. So none
/// gains energy. `times`: of all contacts.
void SceneryContacts::apply_impacts(const StepContext& context, std::uint32_t robot, std::uint32_t which,
                                    const TimeOfImpact* times) const {
  const Robot& r = bodies_.robots[robot];
  Contact contacts[max_contacts];
  TimeOfImpact times_of[max_contacts];
  std::size_t number = 0;
  const auto listed = *robots_[robot].list;
  for (std::size_t k = 0; k < listed.size(); ++k) {
    if (!(which >> k & 1)) continue;
    times_of[number] = times[k];
    contacts[number++] = listed[k];
  }
  const DynamicBody& base = bodies_.base_of(r);
  const FreeBody body(bodies_, base);
  std::uint8_t patch_of[max_contacts];
  const int patches = sort_into_patches(bodies_, {contacts, number}, patch_of);
  *r.impact = {};
  *r.impact_time = context.time;
  Vec3 pushed = Vec3::Zero(), turned = Vec3::Zero();  // by the patches so far
  for (int p = 0; p < patches; ++p) {
    ImpactPoint points[max_contacts];
    std::size_t count = 0;
    for (std::size_t k = 0; k < number; ++k) {
      const Contact& c = contacts[k];
      if (patch_of[k] == p)
        points[count++] = {context, c, times_of[k], bodies_.velocity(c.self, c.point), body, nullptr};
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
