// SPDX-License-Identifier: MIT
#include "standings.hpp"

#include <algorithm>
#include <cstring>

#include "muro/simd/numbers.hpp"

namespace muro::penalty {
namespace {

using lane::numbers_between;

static_assert(sizeof(Contact) == contact_stride * sizeof(double) && offsetof(Contact, point) == 8 &&
              offsetof(Contact, normal) == 32 && offsetof(Contact, depth) == 56 && offsetof(Contact, friction) == 64 &&
              offsetof(Contact, self_shape) == 80 && sizeof(Grip) == grip_stride * sizeof(double) &&
              offsetof(Grip, point) == 8 && offsetof(Grip, stretch) == 32);

/// Two numbers of 4 bytes, side by side.
std::uint64_t both(const void* first) {
  std::uint64_t value;
  std::memcpy(&value, first, sizeof value);
  return value;
}

}  // namespace

/// Robots of a few kinds; one kind is the rule.
struct Standings::Queues {
  std::array<Queue, 4> all;
  std::size_t last = 0, oldest = 0;
};

Standings::Standings(const Bodies& bodies) : bodies_(bodies), kernels_(standing_kernels_for(lane::best_isa())) {
  layouts_.reserve(most_layouts);
}

void Standings::start() {
  standings_.assign(bodies_.robots.size(), {});
  identities_.resize(bodies_.robots.size());
  left_.resize(bodies_.robots.size());
  for (std::size_t i = 0; i < standings_.size(); ++i) {
    const Robot& r = bodies_.robots[i];
    Standing& s = standings_[i];
    const Unit& base = bodies_.base_of(r);
    s.list = r.contacts, s.grips = r.grips, s.mass = base.mass;
    s.world = r.world.get(), s.lag = r.alone ? r.lag.get() : nullptr;
    s.view.base_pose = base.pose->position.data();
    s.view.base_twist = base.twist->linear.data();
    s.view.wrench = base.wrench->force.data();
  }
  for (const Body& b : bodies_.all) {
    if (b.robot == nobody || !b.pose) continue;
    StandingRobot& view = standings_[std::size_t(b.robot)].view;
    if (view.link_pose || b.pose->position.data() == view.base_pose) continue;
    view.link_pose = b.pose->position.data();
    view.link_twist = b.twist->linear.data();
  }
}

bool Standings::knows(std::uint32_t robot, std::span<const Contact> now) const {
  const Identities& known = identities_[robot];
  if (now.size() != standings_[robot].contacts) return false;
  bool same = true;
  for (std::size_t i = 0; i < now.size(); ++i)
    same = same && both(&now[i].self) == known[i].bodies && both(&now[i].self_shape) == known[i].shapes;
  return same;
}

void Standings::push(const Moment& moment, Range block) {
  constexpr std::uint32_t ahead = 8;
  Queues queues;
  const auto robot_of = [&](std::uint32_t number) { return bodies_.robot_of[number]; };
  for (std::uint32_t number = block.begin; number < block.end; ++number) {
    if (number + ahead < block.end && robot_of(number + ahead) != nobody)
      fetch(std::uint32_t(robot_of(number + ahead)));
    if (robot_of(number) != nobody) push_one(moment, std::uint32_t(robot_of(number)), queues);
  }
  for (Queue& q : queues.all) push_queue(moment, q);
}

/// Asks for the memory of a robot whose turn comes soon: in large teams it lies in no near cache.
void Standings::fetch(std::uint32_t robot) const {
  constexpr std::size_t line = 64, contacts = 4;  // as a vehicle has
  const Standing& s = standings_[robot];
  const auto fetch_lines = [](const void* from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(static_cast<const char*>(from) + i);
  };
  fetch_lines((*s.list).data(), contacts * sizeof(Contact));
  fetch_lines((*s.grips).data(), contacts * sizeof(Grip));
  if (!s.view.link_pose) return;
  fetch_lines(s.view.link_pose, contacts * sizeof(Pose));
  fetch_lines(s.view.link_twist, contacts * sizeof(Twist));
}

void Standings::push_one(const Moment& moment, std::uint32_t robot, Queues& queues) {
  Standing& s = standings_[robot];
  const auto contacts = *s.list;
  if (left_[robot] != 0) left_[robot] = 0;  // others have flags in the same line of the cache
  if (contacts.empty()) {
    s.grips.clear();
    s.springs_fit = false;
    bodies_.leave(robot);
    return;
  }
  if (*s.world == 0) {  // it wants to know what it touches, and is not pushed
    s.grips.clear();
    s.springs_fit = false;
    bodies_.leave(robot);
    return;
  }
  if (*s.world != keys::contact_for_all || !s.lag || *s.lag != 0) {
    s.springs_fit = false;
    left_[robot] = 1;
    return;
  }
  if (s.list.revision() != s.revision || contacts.size() != s.contacts) {
    if (!knows(robot, contacts)) learn(robot, contacts);
    s.revision = s.list.revision();
  }
  if (!s.only_scenery) {
    left_[robot] = 1;
    return;
  }
  if (!s.in_lanes || !s.springs_fit) return push_alone(moment, robot);
  const auto fits = [&](const Queue& q) {
    const Standing& first = standings_[q.robots[0]];
    return q.count > 0 && first.layout == s.layout && first.mass == s.mass;
  };
  if (!fits(queues.all[queues.last])) {
    auto q = std::find_if(queues.all.begin(), queues.all.end(), fits);
    if (q == queues.all.end())
      q = std::find_if(queues.all.begin(), queues.all.end(), [](const Queue& other) { return other.count == 0; });
    if (q == queues.all.end()) {
      q = queues.all.begin() + std::ptrdiff_t(queues.oldest++ % queues.all.size());
      push_queue(moment, *q);
    }
    queues.last = std::size_t(q - queues.all.begin());
  }
  Queue& q = queues.all[queues.last];
  StandingRobot& view = q.views[q.count] = s.view;
  view.contacts = contacts[0].point.data();
  view.before = view.grips = (*s.grips)[0].point.data();
  q.robots[q.count++] = robot;
  if (q.count == 8) push_queue(moment, q);
}

void Standings::learn(std::uint32_t robot, std::span<const Contact> contacts) {
  Standing& s = standings_[robot];
  s.contacts = 0;
  s.springs_fit = false;
  s.only_scenery =
      contacts.size() <= most_contacts &&
      std::none_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return bodies_[c.other].twist; });
  if (!s.only_scenery) return;
  for (const Contact& c : contacts)
    identities_[robot][s.contacts++] = {both(&c.self), both(&c.self_shape), bodies_.pair_of(c)};
  s.in_lanes = std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return bodies_[c.other].whole == bodies_[contacts[0].other].whole;
  });
  if (!s.in_lanes) return;
  s.layout = number_of(lay_out(robot, contacts));
  s.in_lanes = s.layout != unknown_layout;
}

Layout Standings::lay_out(std::uint32_t robot, std::span<const Contact> contacts) const {
  const StandingRobot& view = standings_[robot].view;
  const Identities& known = identities_[robot];
  Layout layout;
  for (const Contact& c : contacts) {
    const int k = layout.contacts++;
    if (k == 0 || known[std::size_t(k)].pair != known[std::size_t(k - 1)].pair) {
      const Body& body = bodies_[c.self];
      layout.zeta[layout.groups] = bodies_.materials[bodies_.material_of(c.restitution)].damping_ratio;
      const double *const pose = body.pose->position.data(), *const twist = body.twist->linear.data();
      BodyPlace& place = layout.bodies[layout.groups++];
      place.of_link = pose != view.base_pose;
      place.pose = numbers_between(place.of_link ? view.link_pose : view.base_pose, pose);
      place.twist = numbers_between(place.of_link ? view.link_twist : view.base_twist, twist);
    }
    layout.ends[layout.groups - 1] = std::uint8_t(layout.contacts);
  }
  return layout;
}

std::uint32_t Standings::number_of(const Layout& layout) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find(layouts_.begin(), layouts_.end(), layout);
  if (found != layouts_.end()) return std::uint32_t(found - layouts_.begin());
  if (layouts_.size() == most_layouts) return unknown_layout;
  layouts_.push_back(layout);
  return std::uint32_t(layouts_.size() - 1);
}

void Standings::push_queue(const Moment& moment, Queue& q) {
  if (q.count == 0) return;
  const Standing& first = standings_[q.robots[0]];
  const Layout& layout = layouts_[first.layout];
  StandingWork work{.stiffness = moment.stiffness,
                    .elapsed = moment.elapsed,
                    .mass = &bodies_.masses[first.mass],
                    .layout = &layout,
                    .springs_ends = layout.ends};
  const StandingRobot* views[8];
  for (std::uint32_t i = 0; i < q.count; ++i) views[i] = &q.views[i];
  const unsigned left = kernels_.push(work, views, int(q.count));
  for (std::uint32_t i = 0; left >> i; ++i)
    if (left >> i & 1) push_alone(moment, q.robots[i]);
  q.count = 0;
}

/// Numbers contacts by patch: of one piece of scenery, with normals alike. Returns the number of patches.
int Standings::sort_into_patches(std::span<const Contact> contacts, std::uint8_t* patch_of) const {
  std::size_t first[most_contacts];  // contact of each patch
  int patches = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    int p = patches - 1;
    while (p >= 0 && !(bodies_[c.other].whole == bodies_[contacts[first[p]].other].whole &&
                       contacts[first[p]].normal.dot(c.normal) > same_direction))
      --p;
    if (p < 0) first[p = patches++] = k;
    patch_of[k] = std::uint8_t(p);
  }
  return patches;
}

/// With any patches, and springs in any order.
void Standings::push_alone(const Moment& moment, std::uint32_t robot) {
  Standing& s = standings_[robot];
  const Identities& known = identities_[robot];
  const auto contacts = *s.list;
  const auto springs = *s.grips;
  const Layout layout = lay_out(robot, contacts);
  Grip before[most_contacts];
  std::uint8_t springs_ends[most_contacts], patch_of[most_contacts];
  std::size_t count = 0;
  for (int group = 0; group < layout.groups; ++group) {
    const std::uint64_t pair = known[layout.ends[group] - 1u].pair;
    for (const Grip& g : springs)
      if (g.pair == pair && count < most_contacts) before[count++] = g;
    springs_ends[group] = std::uint8_t(count);
  }
  s.grips.clear();
  for (std::uint32_t k = 0; k < s.contacts; ++k) s.grips.push_back({.pair = known[k].pair});
  s.springs_fit = true;
  StandingRobot view = s.view;
  view.contacts = contacts[0].point.data();
  view.before = before[0].point.data();
  view.grips = (*s.grips)[0].point.data();
  StandingWork work{.stiffness = moment.stiffness,
                    .elapsed = moment.elapsed,
                    .mass = &bodies_.masses[s.mass],
                    .layout = &layout,
                    .springs_ends = springs_ends,
                    .patch_of = patch_of};
  work.patches = sort_into_patches(contacts, patch_of);
  const StandingRobot* const views[] = {&view};
  kernels_.push(work, views, 1);
}

}  // namespace muro::penalty
