// SPDX-License-Identifier: MIT
#include "scenery_contacts.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "scenery_queues.hpp"

namespace muro::penalty {
namespace {

/// Returns two adjacent numbers of 4 bytes as one.
std::uint64_t both(const void* first) {
  std::uint64_t value;
  std::memcpy(&value, first, sizeof value);
  return value;
}

}  // namespace

SceneryContacts::SceneryContacts(const Bodies& bodies)
    : bodies_(bodies), kernels_(scenery_kernels_for(lane::best_isa())) {}

void SceneryContacts::start() {
  robots_.assign(bodies_.robots.size(), {});
  identities_.resize(bodies_.robots.size());
  contacts_.resize(bodies_.robots.size());
  remaining_.assign(bodies_.robots.size(), 1);
  patterns_.clear();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& r = bodies_.robots[i];
    KnownRobot& known = robots_[i];
    const DynamicBody& base = bodies_.base_of(r);
    known.list = r.contacts, known.anchors = r.anchors;
    known.world = r.world.get(), known.lag = r.is_single_body ? r.lag.get() : nullptr;
    known.is_one_link = r.is_one_link, known.may_resist_turning = bool(r.turning_springs);
    known.lasting.contacts = contacts_[i].data();
    known.lasting.base_pose = base.pose->position.data();
    known.lasting.base_twist = base.twist->linear.data();
    known.lasting.mass = &bodies_.masses[base.mass].inverse_mass;
    known.lasting.wrench = base.wrench->force.data();
  }
}

bool SceneryContacts::knows(std::uint32_t robot, std::span<const Contact> now) const {
  const Identities& identities = identities_[robot];
  if (now.size() != robots_[robot].lasting.count) return false;
  bool same = true;
  for (std::size_t i = 0; i < now.size(); ++i)
    same = same && both(&now[i].self) == identities[i].bodies && both(&now[i].self_shape) == identities[i].shapes;
  return same;
}

void SceneryContacts::apply_forces(const StepContext& context, Range block) {
  Queues queues;
  const auto robot_of = [&](std::uint32_t number) { return bodies_.robot_of[number]; };
  for (std::uint32_t number = block.begin; number < block.end; ++number) {
    if (robot_of(number) != not_dynamic) apply_forces_on(context, std::uint32_t(robot_of(number)), queues);
  }
  process_rest(context, queues);
}

void SceneryContacts::apply_forces_on(const StepContext& context, std::uint32_t robot, Queues& queues) {
  KnownRobot& known = robots_[robot];
  const auto contacts = *known.list;
  if (bodies_.tells_contacts) bodies_.robots[robot].told.clear();
  if (remaining_[robot] != 0) {  // avoids a write: other threads have flags in the same cache line
    remaining_[robot] = 0;
    if (const Out<double>& carried = bodies_.robots[robot].carried_mass) *carried = 0;
  }
  const bool by_contact_algorithm = contact_algorithm_resolves(*known.world, kinematic_world);
  // It touches nothing, only reports what it touches, or its motion answers for all of that.
  if (contacts.empty() || !is_moved_by_forces(*known.world) ||
      (!by_contact_algorithm && !touches_robots(robot, contacts))) {
    if (known.is_clear) return;
    known.anchors.clear();
    forget_turning(robot);
    known.anchors_match = false;
    bodies_.clear_wrenches(robot);
    known.is_clear = true;
    return;
  }
  known.is_clear = false;
  if (!by_contact_algorithm || !known.lag || *known.lag != 0) {
    known.anchors_match = false;
    remaining_[robot] = 1;
    return;
  }
  if (known.list.revision() != known.revision || contacts.size() != known.lasting.count) {
    if (!knows(robot, contacts)) analyse(robot, contacts);
    known.revision = known.list.revision();
  }
  if (!known.only_scenery || (known.is_one_link && is_soft(context))) {
    remaining_[robot] = 1;
    return;
  }
  forget_turning(robot);
  if (!known.anchors_match) find_match(robot);
  if (known.is_parting) return process_single(context, robot);
  if (known.was_in_impact && !(known.anchors_match && is_one_patch(contacts))) return process_single(context, robot);
  known.was_in_impact = false;
  if (!known.anchors_match) return enqueue_changed(context, robot, queues);
  Queue& q = queues.of(known.lasting.count, known.lasting.groups);
  q.robots[q.count++] = robot;
  if (q.count == 8) process_queue(context, q);
}

/// Whether one of its contacts is with a body that is not scenery.
bool SceneryContacts::touches_robots(std::uint32_t robot, std::span<const Contact> contacts) {
  KnownRobot& known = robots_[robot];
  if (known.list.revision() != known.robots_revision || contacts.size() != known.robots_length) {
    known.robots_revision = known.list.revision(), known.robots_length = std::uint32_t(contacts.size());
    known.touches_robots =
        std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return bodies_.moves(c.other); });
  }
  return known.touches_robots;
}

/// Clears the springs against turning: nothing that the robot touches resists its turning.
void SceneryContacts::forget_turning(std::uint32_t robot) const {
  if (!robots_[robot].may_resist_turning) return;
  const ListOut<TurningSpring>& springs = bodies_.robots[robot].turning_springs;
  if (!(*springs).empty()) springs.clear();
}

void SceneryContacts::analyse(std::uint32_t robot, std::span<const Contact> contacts) {
  KnownRobot& known = robots_[robot];
  LastingContacts& lasting = known.lasting;
  lasting.count = 0;
  known.anchors_match = false;
  known.only_scenery =
      contacts.size() <= max_contacts && std::none_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return bodies_.moves(c.other) || c.surface.rolling_resistance > 0 || c.surface.spinning_resistance > 0;
      });
  if (!known.only_scenery) return;
  lasting.groups = 0;
  lasting.has_many_materials = lasting.has_many_objects = lasting.rolls = false;
  std::uint8_t first = 0, objects = 0;
  std::uint32_t object_models[max_contacts];
  for (const Contact& c : contacts) {
    const auto k = lasting.count++;
    Identity& identity = identities_[robot][k];
    identity = {both(&c.self), both(&c.self_shape), bodies_.pair_of(c)};
    if (k == 0 || identity.pair != identities_[robot][k - 1u].pair) {
      first = k;
      lasting.groups |= 1u << k;
    }
    const std::uint32_t model = bodies_[c.other].model;
    const auto object = std::uint8_t(std::find(object_models, object_models + objects, model) - object_models);
    if (object == objects) object_models[objects++] = model;
    KernelContact& known_contact = contacts_[robot][k];
    const double *const pose = bodies_[c.self].pose->position.data(), *const twist =
                                                                          bodies_[c.self].twist->linear.data();
    if (k == 0) lasting.pose = pose, lasting.twist = twist;
    known_contact = {.pose = pose - lasting.pose,
                     .twist = twist - lasting.twist,
                     .zeta = bodies_.materials[bodies_.material_of(c.surface.restitution)].damping_ratio,
                     .place = k,
                     .anchor = k,
                     .anchors_begin = first,
                     .object = object,
                     .is_of_disc = bodies_.is_of_disc(c)};
    lasting.rolls = lasting.rolls || twist == lasting.base_twist;
    for (std::uint8_t i = first; i <= k; ++i) contacts_[robot][i].anchors_end = std::uint8_t(k + 1);
    lasting.has_many_materials = lasting.has_many_materials || known_contact.zeta != contacts_[robot][0].zeta;
  }
  lasting.has_many_objects = objects > 1;
  lasting.contacts = patterns_.shared({contacts_[robot].data(), lasting.count});
}

KernelBatch SceneryContacts::batch_of(const StepContext& context) const {
  return {.stiffness = context.stiffness,
          .elapsed = context.elapsed,
          .impact_speed = context.impact_speed,
          .tells_contacts = bodies_.tells_contacts};
}

void SceneryContacts::process_queue(const StepContext& context, Queue& q) {
  if (q.count == 0) return;
  KernelRobot views[8];
  const KernelRobot* all[8];
  for (std::uint32_t i = 0; i < q.count; ++i) {
    const KnownRobot& known = robots_[q.robots[i]];
    KernelRobot& view = views[i] = {known.lasting};
    view.in_order = true;
    view.listed = (*known.list)[0].point.data();
    view.before = view.anchors = (*known.anchors)[0].point.data();
    if (view.rolls) {
      known.anchors.add_details();
      view.ways_before = view.ways = known.anchors.details()[0].way.data();
    }
    if (bodies_.tells_contacts)
      view.forces = Bodies::tell(bodies_.robots[q.robots[i]], *known.list)->wrench.force.data();
    all[i] = &view;
  }
  const unsigned left = kernels_.apply_forces(batch_of(context), all, int(q.count));
  for (std::uint32_t i = 0; left >> i; ++i)
    if (left >> i & 1) process_single(context, q.robots[i]);
  q.count = 0;
}

/// Processes the robots that do not fill the lanes, from those with the most contacts to those with the fewest.
void SceneryContacts::process_rest(const StepContext& context, Queues& queues) {
  Queue all{};
  for (std::uint64_t left = queues.used; left != 0;) {
    const int i = 63 - std::countl_zero(left);
    left &= ~(std::uint64_t(1) << i);
    const Queue& q = queues.by_size[i];
    for (std::uint32_t k = 0; k < q.count; ++k) {
      all.robots[all.count++] = q.robots[k];
      if (all.count == 8) process_queue(context, all);
    }
  }
  process_queue(context, all);
  process_changed(context, queues);
}

}  // namespace muro::penalty
