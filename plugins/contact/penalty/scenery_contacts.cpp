// SPDX-License-Identifier: MIT
#include "scenery_contacts.hpp"

#include <algorithm>
#include <cstring>

#include "muro/simd/numbers.hpp"
#include "overlap.hpp"
#include "spring_batch.hpp"

namespace muro::penalty {
namespace {

using lane::numbers_between;

static_assert(sizeof(Contact) == contact_stride * sizeof(double) && offsetof(Contact, point) == 8 &&
              offsetof(Contact, normal) == 32 && offsetof(Contact, depth) == 56 && offsetof(Contact, surface) == 64 &&
              offsetof(Contact, self_shape) == 96 && sizeof(FrictionAnchor) == anchor_stride * sizeof(double) &&
              offsetof(FrictionAnchor, point) == 8 && offsetof(FrictionAnchor, displacement) == 32 &&
              sizeof(ContactWrench) == force_stride * sizeof(double));

/// Two adjacent numbers of 4 bytes.
std::uint64_t both(const void* first) {
  std::uint64_t value;
  std::memcpy(&value, first, sizeof value);
  return value;
}

}  // namespace

/// Robots of a few kinds; one kind is the rule.
struct SceneryContacts::Queues {
  std::array<Queue, 4> all;
  std::size_t last = 0, oldest = 0;
};

SceneryContacts::SceneryContacts(const Bodies& bodies)
    : bodies_(bodies), kernels_(scenery_kernels_for(lane::best_isa())) {
  layouts_.reserve(max_layouts);
}

void SceneryContacts::start() {
  robots_.assign(bodies_.robots.size(), {});
  identities_.resize(bodies_.robots.size());
  remaining_.resize(bodies_.robots.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& r = bodies_.robots[i];
    KnownRobot& known = robots_[i];
    const DynamicBody& base = bodies_.base_of(r);
    known.list = r.contacts, known.anchors = r.anchors, known.mass = base.mass;
    known.world = r.world.get(), known.lag = r.is_single_body ? r.lag.get() : nullptr;
    known.view.base_pose = base.pose->position.data();
    known.view.base_twist = base.twist->linear.data();
    known.view.wrench = base.wrench->force.data();
  }
  for (const Body& b : bodies_.all) {
    if (b.robot == no_robot || !b.pose) continue;
    KernelRobot& view = robots_[std::size_t(b.robot)].view;
    if (view.link_pose || b.pose->position.data() == view.base_pose) continue;
    view.link_pose = b.pose->position.data();
    view.link_twist = b.twist->linear.data();
  }
}

bool SceneryContacts::knows(std::uint32_t robot, std::span<const Contact> now) const {
  const Identities& identities = identities_[robot];
  if (now.size() != robots_[robot].contacts) return false;
  bool same = true;
  for (std::size_t i = 0; i < now.size(); ++i)
    same = same && both(&now[i].self) == identities[i].bodies && both(&now[i].self_shape) == identities[i].shapes;
  return same;
}

void SceneryContacts::apply_forces(const StepContext& context, Range block) {
  constexpr std::uint32_t ahead = 8;
  Queues queues;
  const auto robot_of = [&](std::uint32_t number) { return bodies_.robot_of[number]; };
  for (std::uint32_t number = block.begin; number < block.end; ++number) {
    if (number + ahead < block.end && robot_of(number + ahead) != no_robot)
      fetch(std::uint32_t(robot_of(number + ahead)));
    if (robot_of(number) != no_robot) apply_forces_on(context, std::uint32_t(robot_of(number)), queues);
  }
  for (Queue& q : queues.all) process_queue(context, q);
}

/// Prefetches the data of a robot that is processed soon: in large teams it is not in a near cache.
void SceneryContacts::fetch(std::uint32_t robot) const {
  constexpr std::size_t line = 64, contacts = 4;  // of a vehicle
  const KnownRobot& known = robots_[robot];
  const auto fetch_lines = [](const void* from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(static_cast<const char*>(from) + i);
  };
  fetch_lines((*known.list).data(), contacts * sizeof(Contact));
  fetch_lines((*known.anchors).data(), contacts * sizeof(FrictionAnchor));
  if (!known.view.link_pose) return;
  fetch_lines(known.view.link_pose, contacts * sizeof(Pose));
  fetch_lines(known.view.link_twist, contacts * sizeof(Twist));
}

void SceneryContacts::apply_forces_on(const StepContext& context, std::uint32_t robot, Queues& queues) {
  KnownRobot& known = robots_[robot];
  const auto contacts = *known.list;
  if (bodies_.tells_contacts) bodies_.robots[robot].told.clear();
  if (remaining_[robot] != 0) remaining_[robot] = 0;  // avoids a write: other threads have flags in the same cache line
  // It touches nothing, or it only reports what it touches.
  if (contacts.empty() || !is_moved_by_forces(*known.world)) {
    known.anchors.clear();
    forget_turning(robot);
    known.anchors_match = false;
    bodies_.clear_wrenches(robot);
    return;
  }
  const bool by_contact_algorithm = contact_algorithm_resolves(*known.world, kinematic_world);
  if (!by_contact_algorithm || !known.lag || *known.lag != 0) {
    known.anchors_match = false;
    remaining_[robot] = 1;
    return;
  }
  if (known.list.revision() != known.revision || contacts.size() != known.contacts) {
    if (!knows(robot, contacts)) analyse(robot, contacts);
    known.revision = known.list.revision();
  }
  if (!known.only_scenery) {
    remaining_[robot] = 1;
    return;
  }
  forget_turning(robot);
  if (!known.anchors_match) find_match(robot);
  if (!known.one_model || !known.anchors_match || known.is_parting) return process_single(context, robot);
  Queue& q = queue_for(context, known, queues);
  KernelRobot& view = q.views[q.count] = known.view;
  view.contacts = contacts[0].point.data();
  view.before = view.anchors = (*known.anchors)[0].point.data();
  if (bodies_.tells_contacts) view.forces = Bodies::tell(bodies_.robots[robot], contacts)->wrench.force.data();
  q.robots[q.count++] = robot;
  if (q.count == 8) process_queue(context, q);
}

/// Nothing that it touches resists its turning.
void SceneryContacts::forget_turning(std::uint32_t robot) const {
  const ListOut<TurningSpring>& springs = bodies_.robots[robot].turning_springs;
  if (springs && !(*springs).empty()) springs.clear();
}

/// The queue of its layout and mass; if there is none, an empty one.
SceneryContacts::Queue& SceneryContacts::queue_for(const StepContext& context, const KnownRobot& robot,
                                                   Queues& queues) {
  const auto fits = [&](const Queue& q) {
    const KnownRobot& first = robots_[q.robots[0]];
    return q.count > 0 && first.layout == robot.layout && first.mass == robot.mass;
  };
  auto& all = queues.all;
  if (fits(all[queues.last])) return all[queues.last];
  auto q = std::find_if(all.begin(), all.end(), fits);
  if (q == all.end()) q = std::find_if(all.begin(), all.end(), [](const Queue& other) { return other.count == 0; });
  if (q == all.end()) {
    q = all.begin() + std::ptrdiff_t(queues.oldest++ % all.size());
    process_queue(context, *q);
  }
  queues.last = std::size_t(q - all.begin());
  return *q;
}

void SceneryContacts::analyse(std::uint32_t robot, std::span<const Contact> contacts) {
  KnownRobot& known = robots_[robot];
  known.contacts = 0;
  known.anchors_match = false;
  known.only_scenery =
      contacts.size() <= max_contacts && std::none_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return bodies_[c.other].twist || c.surface.rolling_resistance > 0 || c.surface.spinning_resistance > 0;
      });
  if (!known.only_scenery) return;
  for (const Contact& c : contacts)
    identities_[robot][known.contacts++] = {both(&c.self), both(&c.self_shape), bodies_.pair_of(c)};
  known.one_model = std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return bodies_[c.other].model == bodies_[contacts[0].other].model;
  });
  if (!known.one_model) return;
  known.layout = number_of(layout_of(robot, contacts, identities_[robot]));
  known.one_model = known.layout != unknown_layout;
}

ContactLayout SceneryContacts::layout_of(std::uint32_t robot, std::span<const Contact> contacts,
                                         const Identities& identities) const {
  const KernelRobot& view = robots_[robot].view;
  ContactLayout layout;
  for (const Contact& c : contacts) {
    const int k = layout.contacts++;
    if (k == 0 || identities[std::size_t(k)].pair != identities[std::size_t(k - 1)].pair) {
      const Body& body = bodies_[c.self];
      layout.zeta[layout.groups] = bodies_.materials[bodies_.material_of(c.surface.restitution)].damping_ratio;
      const double *const pose = body.pose->position.data(), *const twist = body.twist->linear.data();
      BodyOffsets& offsets = layout.bodies[layout.groups++];
      offsets.of_link = pose != view.base_pose;
      offsets.pose = numbers_between(offsets.of_link ? view.link_pose : view.base_pose, pose);
      offsets.twist = numbers_between(offsets.of_link ? view.link_twist : view.base_twist, twist);
    }
    layout.ends[layout.groups - 1] = std::uint8_t(layout.contacts);
  }
  return layout;
}

std::uint32_t SceneryContacts::number_of(const ContactLayout& layout) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find(layouts_.begin(), layouts_.end(), layout);
  if (found != layouts_.end()) return std::uint32_t(found - layouts_.begin());
  if (layouts_.size() == max_layouts) return unknown_layout;
  layouts_.push_back(layout);
  return std::uint32_t(layouts_.size() - 1);
}

void SceneryContacts::process_queue(const StepContext& context, Queue& q) {
  if (q.count == 0) return;
  const KnownRobot& first = robots_[q.robots[0]];
  const ContactLayout& layout = layouts_[first.layout];
  KernelBatch batch{.stiffness = context.stiffness,
                    .elapsed = context.elapsed,
                    .mass = &bodies_.masses[first.mass],
                    .layout = &layout,
                    .anchors_ends = layout.ends,
                    .tells_contacts = bodies_.tells_contacts};
  const KernelRobot* views[8];
  for (std::uint32_t i = 0; i < q.count; ++i) views[i] = &q.views[i];
  const unsigned remaining = kernels_.apply_forces(batch, views, int(q.count));
  for (std::uint32_t i = 0; remaining >> i; ++i)
    if (remaining >> i & 1) process_single(context, q.robots[i]);
  q.count = 0;
}

/// Numbers contacts by patch: of one object of the scenery, with normals alike. Returns the number of patches.
int SceneryContacts::sort_into_patches(std::span<const Contact> contacts, std::uint8_t* patch_of) const {
  std::size_t first[max_contacts];  // contact of each patch
  int patches = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    int p = patches - 1;
    while (p >= 0 && !(bodies_[c.other].model == bodies_[contacts[first[p]].other].model &&
                       contacts[first[p]].normal.dot(c.normal) > same_direction))
      --p;
    if (p < 0) first[p = patches++] = k;
    patch_of[k] = std::uint8_t(p);
  }
  return patches;
}

/// `contacts`: all of the robot, or some. With any patches, and anchors in any order.
SceneryContacts::SpringBatch SceneryContacts::springs_of(std::uint32_t robot, std::span<const Contact> contacts,
                                                         const Identities& identities) const {
  SpringBatch springs;
  springs.layout = layout_of(robot, contacts, identities);
  std::size_t count = 0;
  for (int group = 0; group < springs.layout.groups; ++group) {
    const std::uint64_t pair = identities[springs.layout.ends[group] - 1u].pair;
    for (const FrictionAnchor& g : *robots_[robot].anchors)
      if (g.pair == pair && count < max_contacts) springs.before[count++] = g;
    springs.anchors_ends[group] = std::uint8_t(count);
  }
  springs.patches = sort_into_patches(contacts, springs.patch_of);
  return springs;
}

/// `written`: a friction anchor for each contact.
void SceneryContacts::apply_springs(const StepContext& context, std::uint32_t robot, std::span<const Contact> contacts,
                                    const SpringBatch& springs, FrictionAnchor* written) const {
  KernelRobot view = robots_[robot].view;
  const std::span<const FrictionAnchor> before(springs.before, springs.anchors_ends[springs.layout.groups - 1]);
  bool parts = false;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const FrictionAnchor* const anchor = previous<FrictionAnchor>(before, k, bodies_.pair_of(c), c.point);
    const double approach = -c.normal.dot(bodies_.velocity(c.self, c.point));
    written[k].overlap = unmoved_overlap(context, c, anchor, approach);
    parts = parts || written[k].overlap > 0;
  }
  view.before = springs.before[0].point.data();
  view.anchors = written[0].point.data();
  const KernelBatch batch{.stiffness = context.stiffness,
                          .elapsed = context.elapsed,
                          .mass = &bodies_.masses[robots_[robot].mass],
                          .layout = &springs.layout,
                          .anchors_ends = springs.anchors_ends,
                          .patch_of = springs.patch_of,
                          .patches = springs.patches,
                          .tells_contacts = bodies_.tells_contacts};
  if (bodies_.tells_contacts) view.forces = Bodies::tell(bodies_.robots[robot], contacts)->wrench.force.data();
  const auto apply = [&](const Contact* first) {
    view.contacts = first->point.data();
    const KernelRobot* const views[] = {&view};
    kernels_.apply_forces(batch, views, 1);
  };
  if (!parts) return apply(contacts.data());
  Contact parting[max_contacts];
  std::copy(contacts.begin(), contacts.end(), parting);
  for (std::size_t k = 0; k < contacts.size(); ++k) parting[k].depth -= written[k].overlap;
  apply(parting);
}

void SceneryContacts::process_single(const StepContext& context, std::uint32_t robot) {
  if (bodies_.tells_contacts) bodies_.robots[robot].told.clear();
  TimeOfImpact times[max_contacts];
  if (const std::uint32_t which = find_impacts(context, robot, times); which != 0)
    return process_impacts(context, robot, which, times);
  KnownRobot& known = robots_[robot];
  const auto contacts = *known.list;
  const Identities& identities = identities_[robot];
  const SpringBatch springs = springs_of(robot, contacts, identities);
  known.anchors.clear();
  for (std::uint32_t k = 0; k < known.contacts; ++k) known.anchors.push_back({.pair = identities[k].pair});
  known.anchors_match = true;
  apply_springs(context, robot, contacts, springs, (*known.anchors).data());
  note_parting(known);
}

/// From the state alone, so that a restored run goes the way of the one that it was taken from.
void SceneryContacts::find_match(std::uint32_t robot) {
  KnownRobot& known = robots_[robot];
  const auto all = *known.anchors;
  known.anchors_match = all.size() == known.contacts;
  for (std::size_t k = 0; k < all.size() && known.anchors_match; ++k)
    known.anchors_match = all[k].pair == identities_[robot][k].pair;
  note_parting(known);
}

void SceneryContacts::note_parting(KnownRobot& known) const {
  const auto all = *known.anchors;
  known.is_parting = std::any_of(all.begin(), all.end(), [](const FrictionAnchor& a) { return a.overlap > 0; });
}

}  // namespace muro::penalty
