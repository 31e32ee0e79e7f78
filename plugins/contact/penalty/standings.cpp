// SPDX-License-Identifier: MIT
#include "standings.hpp"

#include <algorithm>
#include <cstring>

namespace muro::penalty {
namespace {

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
  left_.resize(bodies_.robots.size());
  for (std::size_t i = 0; i < standings_.size(); ++i) {
    const Robot& r = bodies_.robots[i];
    standings_[i].mass = r.mass;
    standings_[i].view.base_pose = r.base->position.data();
    standings_[i].view.wrench = r.wrench->force.data();
  }
}

bool Standings::Standing::knows(std::span<const Contact> now) const {
  if (now.size() != contacts) return false;
  bool same = true;
  for (std::uint32_t i = 0; i < contacts; ++i)
    same = same && both(&now[i].self) == identities[i].bodies && both(&now[i].self_shape) == identities[i].shapes;
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
  fetch_lines(s.view.contacts, contacts * sizeof(Contact));
  fetch_lines(s.view.before, contacts * sizeof(Grip));
  fetch_lines(&s.identities, contacts * sizeof(Identity));
  for (std::size_t i = 0; i < contacts; ++i) __builtin_prefetch(s.view.poses[i]), __builtin_prefetch(s.view.twists[i]);
}

void Standings::push_one(const Moment& moment, std::uint32_t robot, Queues& queues) {
  const Robot& r = bodies_.robots[robot];
  Standing& s = standings_[robot];
  const auto contacts = *r.contacts;
  left_[robot] = 0;
  if (contacts.empty()) {
    r.grips.clear();
    s.springs_fit = false;
    *r.wrench = Wrench{};
    return;
  }
  if (r.contacts.revision() != s.revision || contacts.size() != s.contacts) {
    if (!s.knows(contacts)) learn(robot, contacts);
    s.revision = r.contacts.revision();
  }
  if (!s.only_scenery) {
    left_[robot] = 1;
    return;
  }
  if (!s.in_lanes || !s.springs_fit) return push_alone(moment, robot);
  s.view.contacts = contacts[0].point.data();
  s.view.before = s.view.grips = (*r.grips)[0].point.data();
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
    s.identities[s.contacts++] = {both(&c.self), both(&c.self_shape), bodies_.pair_of(c)};
  s.in_lanes = std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return bodies_[c.other].whole == bodies_[contacts[0].other].whole;
  });
  if (!s.in_lanes) return;
  s.layout = number_of(lay_out(robot, contacts));
  s.in_lanes = s.layout != unknown_layout;
}

/// Also notes the bodies of its groups.
Layout Standings::lay_out(std::uint32_t robot, std::span<const Contact> contacts) {
  Standing& s = standings_[robot];
  Layout layout;
  for (const Contact& c : contacts) {
    const int k = layout.contacts++;
    if (k == 0 || s.identities[std::size_t(k)].pair != s.identities[std::size_t(k - 1)].pair) {
      const Body& body = bodies_[c.self];
      layout.zeta[layout.groups] = bodies_.materials[bodies_.material_of(c.restitution)].damping_ratio;
      s.view.poses[layout.groups] = body.pose->position.data();
      s.view.twists[layout.groups] = body.twist->linear.data();
      ++layout.groups;
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
  for (std::uint32_t i = 0; i < q.count; ++i) views[i] = &standings_[q.robots[i]].view;
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
  const Robot& r = bodies_.robots[robot];
  Standing& s = standings_[robot];
  const auto contacts = *r.contacts;
  const auto springs = *r.grips;
  const Layout layout = lay_out(robot, contacts);
  Grip before[most_contacts];
  std::uint8_t springs_ends[most_contacts], patch_of[most_contacts];
  std::size_t count = 0;
  for (int group = 0; group < layout.groups; ++group) {
    const std::uint64_t pair = s.identities[layout.ends[group] - 1u].pair;
    for (const Grip& g : springs)
      if (g.pair == pair && count < most_contacts) before[count++] = g;
    springs_ends[group] = std::uint8_t(count);
  }
  r.grips.clear();
  for (std::uint32_t k = 0; k < s.contacts; ++k) r.grips.push_back({.pair = s.identities[k].pair});
  s.springs_fit = true;
  s.view.contacts = contacts[0].point.data();
  s.view.before = before[0].point.data();
  s.view.grips = (*r.grips)[0].point.data();
  StandingWork work{.stiffness = moment.stiffness,
                    .elapsed = moment.elapsed,
                    .mass = &bodies_.masses[s.mass],
                    .layout = &layout,
                    .springs_ends = springs_ends,
                    .patch_of = patch_of};
  work.patches = sort_into_patches(contacts, patch_of);
  const StandingRobot* const view = &s.view;
  kernels_.push(work, &view, 1);
}

}  // namespace muro::penalty
