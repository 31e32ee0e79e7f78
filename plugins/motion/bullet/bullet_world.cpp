// SPDX-License-Identifier: MIT
#include "bullet_world.hpp"

#include <algorithm>

namespace muro::bullet {

using multibody::PartMotion, multibody::Presence;

namespace {

constexpr double half_reach = 0.5 * NarrowPhase::reach;
constexpr double room = 0.5;  ///< m: scenery is looked up anew when a robot has moved so far

}  // namespace

BulletWorld::BulletWorld(const Settings& settings, std::shared_ptr<const Meshes> meshes)
    : settings_(settings), meshes_(std::move(meshes)), solver_(settings) {}

Collider& BulletWorld::add_collider(const multibody::PartShape& shape, bool moves) {
  Collider& c = colliders_.emplace_back(make_collider(shape, *meshes_, moves));
  c.number = std::uint32_t(colliders_.size() - 1);
  return c;
}

void BulletWorld::add_scenery(const multibody::Fixture& fixture) {
  for (const multibody::PartShape& s : fixture.shapes) {
    Collider& c = add_collider(s, false);
    c.move_to(fixture.pose, half_reach);
    if (c.kind == ShapeKind::plane)
      planes_.push_back(c.number);
    else if (c.shape)
      scenery_.insert(btDbvtVolume::FromMM(bullet(c.low), bullet(c.high)),
                      reinterpret_cast<void*>(std::uintptr_t(c.number)));
  }
}

void BulletWorld::add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) {
  Group& g = groups_.emplace_back();
  g.first = std::uint32_t(colliders_.size());
  for (const multibody::PartShape& s : fixture.shapes) add_collider(s, true).obstacle = std::int32_t(obstacles_.size());
  g.count = std::uint32_t(colliders_.size()) - g.first;
  obstacles_.push_back(&state);
}

void BulletWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  Group g;
  g.first = std::uint32_t(colliders_.size());
  for (std::size_t i = 0; i < model.parts.size(); ++i)
    for (const multibody::PartShape& s : model.parts[i].shapes) {
      Collider& c = add_collider(s, true);
      c.robot = std::int32_t(robots_.size());
      c.part = std::uint32_t(i);
      c.place = c.number - g.first;
    }
  g.count = std::uint32_t(colliders_.size()) - g.first;
  groups_.insert(groups_.begin() + std::ptrdiff_t(robots_.size()), std::move(g));
  robots_.emplace_back(model, state);
  memories_.emplace_back(model, state.memory);
}

void BulletWorld::complete() {
  scenery_.optimizeTopDown();
  for (std::uint32_t i = 0; i < groups_.size(); ++i) order_.push_back(i);
  roots_.resize(robots_.size());
  first_touch_.resize(robots_.size() + 1);
}

void BulletWorld::move(Group& g, const PartMotion* parts) {
  g.low.setConstant(1e300);
  g.high.setConstant(-1e300);
  for (std::uint32_t i = g.first; i < g.first + g.count; ++i) {
    Collider& c = colliders_[i];
    c.move_to(parts[c.part].pose, half_reach);
    if (!c.shape) continue;
    g.low = g.low.cwiseMin(c.low);
    g.high = g.high.cwiseMax(c.high);
  }
}

void BulletWorld::advance(double dt) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& r = robots_[i];
    Group& g = groups_[i];
    g.present = r.presence() != Presence::absent;
    g.simulated = r.simulated();
    if (!g.simulated || r.state().moved_from_outside) memories_[i].forget();
    if (!g.present) continue;
    r.place();
    move(g, &r.part(0));
    for (Wrench& w : r.state().contact) w = Wrench{};
    if (g.simulated) r.prepare(settings_.gravity, dt, scratch_);
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    Group& g = groups_[robots_.size() + i];
    g.present = obstacles_[i]->presence == Presence::obstacle;
    if (!g.present) continue;
    const PartMotion motion{obstacles_[i]->pose, obstacles_[i]->twist};
    move(g, &motion);
  }
  find_pairs();
  find_touches(dt);
  find_islands();
  for (std::size_t i = 0, end = 0; i < islands_.size(); i = end) {
    while (end < islands_.size() && islands_[end].root == islands_[i].root) ++end;
    solve(std::span(islands_).subspan(i, end - i), dt);
  }
  export_contacts(dt);
}

void BulletWorld::find_pairs() {
  pairs_.clear();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Group& g = groups_[i];
    if (!g.simulated) continue;
    find_scenery(g);
    for (std::uint32_t k = g.first; k < g.first + g.count; ++k) {
      const Collider& a = colliders_[k];
      if (!a.shape) continue;
      for (const std::uint32_t plane : planes_) pairs_.push_back({&a, &colliders_[plane]});
      for (const std::uint32_t other : g.near)
        if (const Collider& b = colliders_[other]; overlap(a.low, a.high, b.low, b.high)) pairs_.push_back({&a, &b});
    }
    if (robots_[i].model().self_collision) meet_itself(g, robots_[i]);
  }
  // by the least x: insertion, for the order hardly changes from step to step
  for (std::size_t i = 1; i < order_.size(); ++i)
    for (std::size_t k = i; k > 0 && groups_[order_[k]].low.x() < groups_[order_[k - 1]].low.x(); --k)
      std::swap(order_[k], order_[k - 1]);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Group& a = groups_[order_[i]];
    if (!a.present) continue;
    for (std::size_t k = i + 1; k < order_.size(); ++k) {
      const Group& b = groups_[order_[k]];
      if (b.low.x() > a.high.x()) break;
      if (b.present && (a.simulated || b.simulated) && overlap(a.low, a.high, b.low, b.high)) meet(a, b);
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) {
    return x.a->number != y.a->number ? x.a->number < y.a->number : x.b->number < y.b->number;
  });
}

void BulletWorld::find_scenery(Group& g) {
  if ((g.low.array() >= g.room_low.array()).all() && (g.high.array() <= g.room_high.array()).all()) return;
  struct Collect final : btDbvt::ICollide {
    std::vector<std::uint32_t>& found;
    explicit Collect(std::vector<std::uint32_t>& list) : found(list) {}
    void Process(const btDbvtNode* leaf) override {
      found.push_back(std::uint32_t(reinterpret_cast<std::uintptr_t>(leaf->data)));
    }
  };
  g.room_low = g.low.array() - room;
  g.room_high = g.high.array() + room;
  g.near.clear();
  Collect collect(g.near);
  scenery_.collideTV(scenery_.m_root, btDbvtVolume::FromMM(bullet(g.room_low), bullet(g.room_high)), collect);
}

void BulletWorld::meet(const Group& a, const Group& b) {
  const bool in_order = a.simulated && (!b.simulated || a.first < b.first);
  const Group &first = in_order ? a : b, &second = in_order ? b : a;
  for (std::uint32_t i = first.first; i < first.first + first.count; ++i) {
    const Collider& x = colliders_[i];
    if (!x.shape || !overlap(x.low, x.high, second.low, second.high)) continue;
    for (std::uint32_t k = second.first; k < second.first + second.count; ++k) {
      const Collider& y = colliders_[k];
      if (y.shape && overlap(x.low, x.high, y.low, y.high)) pairs_.push_back({&x, &y});
    }
  }
}

void BulletWorld::meet_itself(const Group& g, const Robot& robot) {
  for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
    for (std::uint32_t k = i + 1; k < g.first + g.count; ++k) {
      const Collider &a = colliders_[i], &b = colliders_[k];
      if (a.shape && b.shape && a.part != b.part && !robot.model().adjacent(a.part, b.part) &&
          overlap(a.low, a.high, b.low, b.high))
        pairs_.push_back({&a, &b});
    }
}

PartMotion BulletWorld::motion_of(const Collider& c) const {
  if (c.robot >= 0) return robots_[std::size_t(c.robot)].part(c.part);
  if (c.obstacle >= 0) return {obstacles_[std::size_t(c.obstacle)]->pose, obstacles_[std::size_t(c.obstacle)]->twist};
  return {};
}

void BulletWorld::find_touches(double dt) {
  constexpr double resting = 1e-3;  // m
  touches_.clear();
  ContactPoint points[NarrowPhase::most];
  std::size_t robot = 0;
  first_touch_[0] = 0;
  for (const Pair& p : pairs_) {
    for (; robot < std::size_t(p.a->robot); ++robot) first_touch_[robot + 1] = std::uint32_t(touches_.size());
    const int n = narrow_phase_.find(*p.a, *p.b, points);
    if (n == 0) continue;
    const PartMotion a = motion_of(*p.a), b = motion_of(*p.b);
    for (int i = 0; i < n; ++i) {
      const Vec3& at = points[i].point;
      const Vec3 slip = a.twist.at(at - a.pose.position) - b.twist.at(at - b.pose.position);
      if (points[i].gap > resting - 2 * dt * slip.dot(points[i].normal)) continue;
      Touch& t = touches_.emplace_back();
      t.a = p.a;
      t.b = p.b;
      t.at = points[i];
      t.slip = slip;
    }
  }
  for (; robot < robots_.size(); ++robot) first_touch_[robot + 1] = std::uint32_t(touches_.size());
}

std::span<Touch> BulletWorld::touches_of(std::uint32_t robot) {
  return std::span(touches_).subspan(first_touch_[robot], first_touch_[robot + 1] - first_touch_[robot]);
}

void BulletWorld::find_islands() {
  for (std::uint32_t i = 0; i < roots_.size(); ++i) roots_[i] = i;
  const auto root_of = [&](std::uint32_t i) {
    while (roots_[i] != i) i = roots_[i];
    return i;
  };
  for (const Touch& t : touches_) {
    if (t.b->robot < 0 || t.b->robot == t.a->robot || !robots_[std::size_t(t.b->robot)].simulated()) continue;
    const std::uint32_t a = root_of(std::uint32_t(t.a->robot)), b = root_of(std::uint32_t(t.b->robot));
    roots_[std::max(a, b)] = std::min(a, b);
  }
  islands_.clear();
  for (std::uint32_t i = 0; i < roots_.size(); ++i)
    if (robots_[i].simulated()) islands_.push_back({i, root_of(i)});
  std::sort(islands_.begin(), islands_.end(),
            [](const Island& x, const Island& y) { return x.root != y.root ? x.root < y.root : x.robot < y.robot; });
}

void BulletWorld::solve(std::span<const Island> island, double dt) {
  solver_.begin(dt);
  for (const Island& i : island) solver_.add(robots_[i.robot], memories_[i.robot]);
  for (const Island& i : island) {
    memories_[i.robot].recall(touches_of(i.robot));
    for (Touch& t : touches_of(i.robot)) {
      Robot* b =
          t.b->robot >= 0 && robots_[std::size_t(t.b->robot)].simulated() ? &robots_[std::size_t(t.b->robot)] : nullptr;
      const PartMotion other = b ? PartMotion{} : motion_of(*t.b);
      solver_.add(t, robots_[i.robot], b, other.twist.at(t.at.point - other.pose.position));
    }
  }
  solver_.solve();
  for (std::size_t k = 0; k < island.size(); ++k) {
    const std::uint32_t robot = island[k].robot;
    for (Touch& t : touches_of(robot)) solver_.finish(t);
    memories_[robot].keep(touches_of(robot));
    solver_.finish(robots_[robot], k, memories_[robot]);
  }
}

void BulletWorld::export_contacts(double dt) {
  for (const Touch& t : touches_) {
    if (t.row < 0) continue;
    const Vec3 force = t.impulse / dt;
    const auto act = [&](const Collider& c, const Vec3& f) {
      if (c.robot < 0 || !robots_[std::size_t(c.robot)].simulated()) return;
      Robot& r = robots_[std::size_t(c.robot)];
      r.set_touched();
      r.state().contact[c.body].add_force(f, t.at.point - r.part(c.part).pose.position);
    };
    act(*t.a, force);
    act(*t.b, -force);
  }
  for (Robot& r : robots_)
    if (r.simulated()) r.finish(settings_.gravity, dt);
}

}  // namespace muro::bullet
