// SPDX-License-Identifier: MIT
#include "scenery_contacts.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <new>

#include "overlap.hpp"

namespace muro::penalty {
namespace {

static_assert(sizeof(Contact) == contact_stride * sizeof(double) && offsetof(Contact, point) == 8 &&
              offsetof(Contact, normal) == 32 && offsetof(Contact, depth) == 56 && offsetof(Contact, surface) == 64 &&
              offsetof(Contact, self_shape) == 96 && sizeof(FrictionAnchor) == anchor_stride * sizeof(double) &&
              offsetof(FrictionAnchor, point) == 8 && offsetof(FrictionAnchor, displacement) == 32 &&
              sizeof(AnchorDetail) == way_stride * sizeof(double) && offsetof(AnchorDetail, way) == 8 &&
              sizeof(ContactWrench) == force_stride * sizeof(double));

/// Returns two adjacent numbers of 4 bytes as one.
std::uint64_t both(const void* first) {
  std::uint64_t value;
  std::memcpy(&value, first, sizeof value);
  return value;
}

}  // namespace

/// Input of the kernel for a robot whose contacts are not those of the step before.
struct SceneryContacts::Plan {
  int count = 0;
  std::uint32_t groups = 0;
  KernelContact contacts[max_contacts];
  std::size_t before_count = 0;
  FrictionAnchor before[max_contacts];  ///< anchors of the step before, group by group
  AnchorDetail details[max_contacts];   ///< details of these anchors
};

/// Queues by number of contacts, since the kernel takes as long as the robot with the most of them, and by their
/// groups, since it takes longer if these differ.
struct SceneryContacts::Queues {
  static constexpr std::uint32_t sizes = 8, patterns = 8;  // the last size is for all larger numbers

  std::uint64_t used = 0;  ///< a bit for each of `by_size` that is in use
  Queue by_size[sizes * patterns];
  Queue changed{};
  alignas(Plan) std::byte plans[8][sizeof(Plan)];  ///< of `changed`; most steps need none, so they are not initialised

  Plan& plan(std::uint32_t i) { return *std::launder(reinterpret_cast<Plan*>(plans[i])); }

  /// Returns a queue. `groups`: see KernelRobot. Different groups may share a queue, which only costs time.
  Queue& of(std::uint32_t contacts, std::uint32_t groups) {
    constexpr std::uint32_t golden_ratio = 0x9e3779b1;  // 2^32 times that ratio; spreads bits
    const std::uint32_t i = std::min(contacts - 1, sizes - 1) * patterns + (groups * golden_ratio >> 29);
    if (!(used >> i & 1)) by_size[i].count = 0;
    used |= std::uint64_t(1) << i;
    return by_size[i];
  }
};

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
