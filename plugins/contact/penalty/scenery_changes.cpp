// SPDX-License-Identifier: MIT
// Robots some of whose contacts with scenery are new, or gone: their anchors are matched one by one.
#include <algorithm>
#include <cstring>
#include <limits>

#include "overlap.hpp"
#include "scenery_queues.hpp"

namespace muro::penalty {
namespace {

static_assert(sizeof(Contact) == contact_stride * sizeof(double) && offsetof(Contact, point) == 8 &&
              offsetof(Contact, normal) == 32 && offsetof(Contact, depth) == 56 && offsetof(Contact, surface) == 64 &&
              offsetof(Contact, self_shape) == 96 && sizeof(FrictionAnchor) == anchor_stride * sizeof(double) &&
              offsetof(FrictionAnchor, point) == 8 && offsetof(FrictionAnchor, displacement) == 32 &&
              sizeof(AnchorDetail) == way_stride * sizeof(double) && offsetof(AnchorDetail, way) == 8 &&
              sizeof(ContactWrench) == force_stride * sizeof(double));

}  // namespace

/// Adds the contacts `which` to the plan (a bit for each contact that is a spring). Finds their anchors, in any order.
void SceneryContacts::make_plan(std::uint32_t robot, std::uint32_t which, Plan& plan) const {
  std::uint64_t pair = 0;
  std::size_t begin = 0;
  for (std::uint32_t k = 0; k < robots_[robot].lasting.count; ++k) {
    if (!(which >> k & 1)) continue;
    const std::uint64_t own = identities_[robot][k].pair;
    if (plan.count == 0 || own != pair) {
      pair = own;
      plan.groups |= 1u << plan.count;
      begin = plan.before_count;
      for (const FrictionAnchor& a : *robots_[robot].anchors)
        if (a.pair == pair && plan.before_count < max_contacts) {
          plan.details[plan.before_count] = robots_[robot].anchors.detail_of(a);
          plan.before[plan.before_count++] = a;
        }
    }
    KernelContact& c = plan.contacts[plan.count++] = contacts_[robot][k];
    c.anchors_begin = std::uint8_t(begin);
    c.anchors_end = std::uint8_t(plan.before_count);
  }
}

/// Returns the kernel's view of a robot. Anchors must have a place in the list already.
KernelRobot SceneryContacts::view_of(std::uint32_t robot, const Plan& plan) const {
  const KnownRobot& known = robots_[robot];
  KernelRobot view{known.lasting};
  view.count = std::uint8_t(plan.count);
  view.contacts = plan.contacts;
  view.groups = plan.groups;
  view.listed = (*known.list)[0].point.data();
  view.before = plan.before[0].point.data();
  view.anchors = (*known.anchors)[0].point.data();
  if (!view.rolls) return view;
  known.anchors.add_details();
  view.ways_before = plan.details[0].way.data();
  view.ways = known.anchors.details()[0].way.data();
  return view;
}

/// Enqueues a robot with some contacts that are new, or gone.
void SceneryContacts::enqueue_changed(const StepContext& context, std::uint32_t robot, Queues& queues) {
  Queue& q = queues.changed;
  const auto contacts = *robots_[robot].list;
  Plan& plan = *new (queues.plans[q.count]) Plan;
  make_plan(robot, 0xffffffffu, plan);
  for (const KernelContact& c : std::span(plan.contacts, std::size_t(plan.count)))
    if (c.anchors_begin == c.anchors_end && contacts[c.place].depth > least_overlap)
      return process_single(context, robot);
  q.robots[q.count++] = robot;
  if (q.count == 8) process_changed(context, queues);
}

void SceneryContacts::process_changed(const StepContext& context, Queues& queues) {
  Queue& q = queues.changed;
  if (q.count == 0) return;
  KernelRobot views[8];
  const KernelRobot* all[8];
  for (std::uint32_t i = 0; i < q.count; ++i) {
    const std::uint32_t robot = q.robots[i];
    KnownRobot& known = robots_[robot];
    known.anchors.clear();
    for (std::uint32_t k = 0; k < known.lasting.count; ++k)
      known.anchors.push_back({.pair = identities_[robot][k].pair});
    known.anchors_match = true;
    views[i] = view_of(robot, queues.plan(i));
    views[i].is_changed = true;
    if (bodies_.tells_contacts) views[i].forces = Bodies::tell(bodies_.robots[robot], *known.list)->wrench.force.data();
    all[i] = &views[i];
  }
  const unsigned left = kernels_.apply_forces(batch_of(context), all, int(q.count));
  for (std::uint32_t i = 0; left >> i; ++i) {
    if (!(left >> i & 1)) continue;
    const KnownRobot& known = robots_[q.robots[i]];
    known.anchors.clear();
    const Plan& plan = queues.plan(i);
    for (std::size_t k = 0; k < plan.before_count; ++k) known.anchors.push_back(plan.before[k], plan.details[k]);
    process_single(context, q.robots[i]);
  }
  q.count = 0;
}

/// Whether some contact has an overlap that no motion has made. `overlaps`: of each contact of the list, m; out.
bool SceneryContacts::find_overlaps(const StepContext& context, std::uint32_t robot, const Plan& plan,
                                    double* overlaps) const {
  const auto contacts = *robots_[robot].list;
  const std::span<const FrictionAnchor> before(plan.before, plan.before_count);
  bool any = false;
  for (int i = 0; i < plan.count; ++i) {
    const std::size_t k = plan.contacts[i].place;
    const Contact& c = contacts[k];
    const FrictionAnchor* const anchor =
        previous<FrictionAnchor>(before, std::size_t(i), identities_[robot][k].pair, c.point);
    const double approach = -c.normal.dot(bodies_.velocity(c.self, c.point));
    overlaps[k] = unmoved_overlap(context, c, anchor ? &plan.details[anchor - plan.before] : nullptr, approach);
    any = any || overlaps[k] > 0;
  }
  return any;
}

/// Applies the springs of the plan. `overlaps`: of each contact of the list, m; null: none.
void SceneryContacts::apply_springs(const StepContext& context, std::uint32_t robot, const Plan& plan,
                                    const double* overlaps) const {
  const auto contacts = *robots_[robot].list;
  KernelRobot view = view_of(robot, plan);
  if (bodies_.tells_contacts) {
    for (int i = 0; i < plan.count; ++i)
      Bodies::tell(bodies_.robots[robot], contacts.subspan(plan.contacts[i].place, 1));
    view.forces = (*bodies_.robots[robot].told)[0].wrench.force.data();
  }
  KernelBatch batch = batch_of(context);
  batch.impact_speed = std::numeric_limits<double>::infinity();
  const auto apply = [&](const Contact* first) {
    view.listed = first->point.data();
    const KernelRobot* const views[] = {&view};
    kernels_.apply_forces(batch, views, 1);
  };
  if (!overlaps) return apply(contacts.data());
  Contact parting[max_contacts];
  std::copy(contacts.begin(), contacts.end(), parting);
  for (std::size_t k = 0; k < contacts.size(); ++k) parting[k].depth -= overlaps[k];
  apply(parting);
}

/// Processes one robot alone. Finds impacts and overlaps that no motion has made.
void SceneryContacts::process_single(const StepContext& context, std::uint32_t robot) {
  if (bodies_.tells_contacts) bodies_.robots[robot].told.clear();
  KnownRobot& known = robots_[robot];
  TimeOfImpact times[max_contacts];
  const std::uint32_t impacts = find_impacts(context, robot, times);
  double overlaps[max_contacts] = {};
  Plan plan;
  make_plan(robot, ~impacts, plan);
  const bool parts = find_overlaps(context, robot, plan, overlaps);
  known.anchors.clear();
  for (std::uint32_t k = 0; k < known.lasting.count; ++k) {
    const std::uint64_t pair = identities_[robot][k].pair;
    if (impacts >> k & 1)
      known.anchors.push_back(anchor_of_impact(pair));
    else
      known.anchors.push_back({.pair = pair}, {.overlap = overlaps[k]});
  }
  known.anchors_match = true;
  known.is_parting = parts;
  known.was_in_impact = impacts != 0;
  if (impacts != 0) bodies_.clear_wrenches(robot);
  if (plan.count > 0) apply_springs(context, robot, plan, parts ? overlaps : nullptr);
  if (impacts != 0) apply_impacts(context, robot, impacts, times);
}

/// Compares anchors with contacts. It uses the state alone, so that a restored run goes on as the original run did.
void SceneryContacts::find_match(std::uint32_t robot) {
  KnownRobot& known = robots_[robot];
  const auto all = *known.anchors;
  known.anchors_match = all.size() == known.lasting.count;
  for (std::size_t k = 0; k < all.size() && known.anchors_match; ++k)
    known.anchors_match = all[k].pair == identities_[robot][k].pair;
  const auto details = known.anchors.details();
  known.is_parting = std::any_of(details.begin(), details.end(), [](const AnchorDetail& d) { return d.overlap > 0; });
  known.was_in_impact = std::any_of(all.begin(), all.end(), is_of_impact);
}

bool SceneryContacts::is_one_patch(std::span<const Contact> contacts) const {
  return std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return bodies_[c.other].model == bodies_[contacts[0].other].model &&
           c.normal.dot(contacts[0].normal) > same_direction;
  });
}

}  // namespace muro::penalty
