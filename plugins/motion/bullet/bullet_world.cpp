// SPDX-License-Identifier: MIT
#include "bullet_world.hpp"

#include <algorithm>

namespace muro::bullet {

using multibody::BodyState, multibody::MotionType;

namespace {

constexpr double half_margin = 0.5 * NarrowPhase::margin;
constexpr double fat_aabb_margin = 0.5;  ///< m: after this distance a robot finds nearby scenery anew

}  // namespace

BulletWorld::BulletWorld(const BulletSettings& settings, std::shared_ptr<const BulletMeshes> meshes)
    : settings_(settings), meshes_(std::move(meshes)), solver_(settings) {}

Collider& BulletWorld::add_collider(const multibody::BodyShape& shape, bool moves) {
  Collider& c = colliders_.emplace_back(make_collider(shape, *meshes_, moves));
  c.number = std::uint32_t(colliders_.size() - 1);
  return c;
}

void BulletWorld::add_static_body(const multibody::ExternalBody& body) {
  for (const multibody::BodyShape& s : body.shapes) {
    Collider& c = add_collider(s, false);
    if (!c.shape || !c.shape->isConcave()) c.scenery = &body.name;
    c.move_to(body.pose, half_margin);
    if (is_ground(c.kind))
      grounds_.push_back(c.number);
    else if (c.shape)
      scenery_.insert(btDbvtVolume::FromMM(to_bullet(c.aabb_min), to_bullet(c.aabb_max)),
                      reinterpret_cast<void*>(std::uintptr_t(c.number)));
  }
}

void BulletWorld::add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) {
  CollisionObject& o = objects_.emplace_back();
  o.first = std::uint32_t(colliders_.size());
  for (const multibody::BodyShape& s : body.shapes)
    add_collider(s, true).kinematic_body = std::int32_t(kinematic_bodies_.size());
  o.count = std::uint32_t(colliders_.size()) - o.first;
  kinematic_bodies_.push_back(&state);
}

void BulletWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  CollisionObject o;
  o.first = std::uint32_t(colliders_.size());
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (const multibody::BodyShape& s : model.bodies[i].shapes) {
      Collider& c = add_collider(s, true);
      c.robot = std::int32_t(robots_.size());
      c.body = std::uint32_t(i);
      c.shape_index = c.number - o.first;
    }
  o.count = std::uint32_t(colliders_.size()) - o.first;
  objects_.insert(objects_.begin() + std::ptrdiff_t(robots_.size()), std::move(o));
  robots_.emplace_back(model, state);
  caches_.emplace_back(model, state.memory);
}

void BulletWorld::complete() {
  scenery_.optimizeTopDown();
  for (std::uint32_t i = 0; i < objects_.size(); ++i) order_.push_back(i);
  roots_.resize(robots_.size());
  first_contact_.resize(robots_.size() + 1);
}

void BulletWorld::move(CollisionObject& o, const BodyState* bodies) {
  o.aabb_min.setConstant(1e300);
  o.aabb_max.setConstant(-1e300);
  for (std::uint32_t i = o.first; i < o.first + o.count; ++i) {
    Collider& c = colliders_[i];
    c.move_to(bodies[c.body].pose, half_margin);
    if (!c.shape) continue;
    o.aabb_min = o.aabb_min.cwiseMin(c.aabb_min);
    o.aabb_max = o.aabb_max.cwiseMax(c.aabb_max);
  }
}

void BulletWorld::advance(double dt) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    BulletRobot& r = robots_[i];
    CollisionObject& o = objects_[i];
    o.enabled = r.motion_type() != MotionType::disabled;
    o.dynamic = r.is_dynamic();
    if (!o.dynamic || r.state().moved_from_outside) caches_[i].clear();
    if (!o.enabled) continue;
    r.update_kinematics();
    move(o, &r.body_state(0));
    r.state().clear_contacts();
    if (o.dynamic) r.prepare(settings_.gravity, dt, scratch_);
  }
  for (std::size_t i = 0; i < kinematic_bodies_.size(); ++i) {
    CollisionObject& o = objects_[robots_.size() + i];
    o.enabled = kinematic_bodies_[i]->motion_type == MotionType::kinematic;
    if (!o.enabled) continue;
    const BodyState state{kinematic_bodies_[i]->pose, kinematic_bodies_[i]->twist};
    move(o, &state);
  }
  find_pairs();
  find_contacts(dt);
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
    CollisionObject& o = objects_[i];
    if (!o.dynamic) continue;
    find_scenery(o);
    for (std::uint32_t k = o.first; k < o.first + o.count; ++k) {
      const Collider& a = colliders_[k];
      if (!a.shape) continue;
      for (const std::uint32_t ground : grounds_) pairs_.push_back({&a, &colliders_[ground]});
      for (const std::uint32_t other : o.nearby_scenery)
        if (const Collider& b = colliders_[other]; overlap(a.aabb_min, a.aabb_max, b.aabb_min, b.aabb_max))
          pairs_.push_back({&a, &b});
    }
    if (robots_[i].model().self_collision) add_self_collision_pairs(o, robots_[i]);
  }
  // sort by the smallest x, by insertion because the order hardly changes from step to step
  for (std::size_t i = 1; i < order_.size(); ++i)
    for (std::size_t k = i; k > 0 && objects_[order_[k]].aabb_min.x() < objects_[order_[k - 1]].aabb_min.x(); --k)
      std::swap(order_[k], order_[k - 1]);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const CollisionObject& a = objects_[order_[i]];
    if (!a.enabled) continue;
    for (std::size_t k = i + 1; k < order_.size(); ++k) {
      const CollisionObject& b = objects_[order_[k]];
      if (b.aabb_min.x() > a.aabb_max.x()) break;
      if (b.enabled && (a.dynamic || b.dynamic) && overlap(a.aabb_min, a.aabb_max, b.aabb_min, b.aabb_max))
        add_pairs_between(a, b);
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) {
    return x.a->number != y.a->number ? x.a->number < y.a->number : x.b->number < y.b->number;
  });
}

void BulletWorld::find_scenery(CollisionObject& o) {
  if ((o.aabb_min.array() >= o.fat_aabb_min.array()).all() && (o.aabb_max.array() <= o.fat_aabb_max.array()).all())
    return;
  struct Collect final : btDbvt::ICollide {
    std::vector<std::uint32_t>& found;
    explicit Collect(std::vector<std::uint32_t>& list) : found(list) {}
    void Process(const btDbvtNode* leaf) override {
      found.push_back(std::uint32_t(reinterpret_cast<std::uintptr_t>(leaf->data)));
    }
  };
  o.fat_aabb_min = o.aabb_min.array() - fat_aabb_margin;
  o.fat_aabb_max = o.aabb_max.array() + fat_aabb_margin;
  o.nearby_scenery.clear();
  Collect collect(o.nearby_scenery);
  scenery_.collideTV(scenery_.m_root, btDbvtVolume::FromMM(to_bullet(o.fat_aabb_min), to_bullet(o.fat_aabb_max)),
                     collect);
}

void BulletWorld::add_pairs_between(const CollisionObject& a, const CollisionObject& b) {
  const bool in_order = a.dynamic && (!b.dynamic || a.first < b.first);
  const CollisionObject &first = in_order ? a : b, &second = in_order ? b : a;
  for (std::uint32_t i = first.first; i < first.first + first.count; ++i) {
    const Collider& x = colliders_[i];
    if (!x.shape || !overlap(x.aabb_min, x.aabb_max, second.aabb_min, second.aabb_max)) continue;
    for (std::uint32_t k = second.first; k < second.first + second.count; ++k) {
      const Collider& y = colliders_[k];
      if (y.shape && overlap(x.aabb_min, x.aabb_max, y.aabb_min, y.aabb_max)) pairs_.push_back({&x, &y});
    }
  }
}

void BulletWorld::add_self_collision_pairs(const CollisionObject& o, const BulletRobot& robot) {
  for (std::uint32_t i = o.first; i < o.first + o.count; ++i)
    for (std::uint32_t k = i + 1; k < o.first + o.count; ++k) {
      const Collider &a = colliders_[i], &b = colliders_[k];
      if (a.shape && b.shape && a.body != b.body && !robot.model().adjacent(a.body, b.body) &&
          overlap(a.aabb_min, a.aabb_max, b.aabb_min, b.aabb_max))
        pairs_.push_back({&a, &b});
    }
}

BodyState BulletWorld::state_of(const Collider& c) const {
  if (c.robot >= 0) return robots_[std::size_t(c.robot)].body_state(c.body);
  if (c.kinematic_body >= 0)
    return {kinematic_bodies_[std::size_t(c.kinematic_body)]->pose,
            kinematic_bodies_[std::size_t(c.kinematic_body)]->twist};
  return {};
}

void BulletWorld::find_contacts(double dt) {
  constexpr double resting_distance = 1e-3;  // m
  contacts_.clear();
  ContactPoint points[NarrowPhase::max_points];
  std::size_t robot = 0;
  first_contact_[0] = 0;
  for (const Pair& p : pairs_) {
    for (; robot < std::size_t(p.a->robot); ++robot) first_contact_[robot + 1] = std::uint32_t(contacts_.size());
    const int n = narrow_phase_.find(*p.a, *p.b, points);
    if (n == 0) continue;
    if (p.b->scenery)
      for (int i = 0; i < n; ++i)
        robots_[std::size_t(p.a->robot)].state().overlap.add(-points[i].gap, p.a->loaded_link, *p.b->scenery);
    const BodyState a = state_of(*p.a), b = state_of(*p.b);
    const std::size_t first = contacts_.size();
    for (int i = 0; i < n; ++i) {
      const Vec3& at = points[i].position;
      const Vec3 relative_velocity = a.twist.at(at - a.pose.position) - b.twist.at(at - b.pose.position);
      if (points[i].gap > resting_distance - 2 * dt * relative_velocity.dot(points[i].normal)) continue;
      SolverContact& contact = contacts_.emplace_back();
      contact.a = p.a;
      contact.b = p.b;
      contact.point = points[i];
      contact.relative_velocity = relative_velocity;
      contact.relative_spin = points[i].normal.dot(a.twist.angular - b.twist.angular);
    }
    find_cells(std::span(contacts_).subspan(first));
  }
  for (; robot < robots_.size(); ++robot) first_contact_[robot + 1] = std::uint32_t(contacts_.size());
}

void BulletWorld::find_cells(std::span<SolverContact> pair) {
  SolverContact* touching[NarrowPhase::max_points];
  std::size_t count = 0;
  for (SolverContact& c : pair)
    if (c.point.gap < 0 &&
        (count == 0 || c.point.normal.dot(touching[0]->point.normal) > contact_geometry::same_direction))
      touching[count++] = &c;
  if (count < 2) return;
  contact_geometry::find_cells(
      count, contact_geometry::is_of_disc(pair[0].a->extent, pair[0].b->extent),
      [&](std::size_t i) { return touching[i]->point.position.data(); },
      [&](std::size_t i, const Vec3& cell) { touching[i]->cell = cell; });
}

std::span<SolverContact> BulletWorld::contacts_of(std::uint32_t robot) {
  return std::span(contacts_).subspan(first_contact_[robot], first_contact_[robot + 1] - first_contact_[robot]);
}

void BulletWorld::find_islands() {
  for (std::uint32_t i = 0; i < roots_.size(); ++i) roots_[i] = i;
  const auto root_of = [&](std::uint32_t i) {
    while (roots_[i] != i) i = roots_[i];
    return i;
  };
  for (const SolverContact& contact : contacts_) {
    if (contact.b->robot < 0 || contact.b->robot == contact.a->robot ||
        !robots_[std::size_t(contact.b->robot)].is_dynamic())
      continue;
    const std::uint32_t a = root_of(std::uint32_t(contact.a->robot)), b = root_of(std::uint32_t(contact.b->robot));
    roots_[std::max(a, b)] = std::min(a, b);
  }
  islands_.clear();
  for (std::uint32_t i = 0; i < roots_.size(); ++i)
    if (robots_[i].is_dynamic()) islands_.push_back({i, root_of(i)});
  std::sort(islands_.begin(), islands_.end(),
            [](const Island& x, const Island& y) { return x.root != y.root ? x.root < y.root : x.robot < y.robot; });
}

void BulletWorld::solve(std::span<const Island> island, double dt) {
  solver_.begin(dt);
  for (const Island& i : island) solver_.add(robots_[i.robot], caches_[i.robot]);
  for (const Island& i : island) {
    caches_[i.robot].match(contacts_of(i.robot));
    const std::span<SolverContact> contacts = contacts_of(i.robot);
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
      const Collider &own = *contacts[begin].a, &other = *contacts[begin].b;
      while (end < contacts.size() && contacts[end].a == &own && contacts[end].b == &other) ++end;
      BulletRobot* b = other.robot >= 0 && robots_[std::size_t(other.robot)].is_dynamic()
                           ? &robots_[std::size_t(other.robot)]
                           : nullptr;
      solver_.add(contacts.subspan(begin, end - begin), robots_[i.robot], b, b ? BodyState{} : state_of(other));
    }
  }
  solver_.solve();
  for (std::size_t k = 0; k < island.size(); ++k) {
    const std::uint32_t robot = island[k].robot;
    for (SolverContact& contact : contacts_of(robot)) solver_.finish(contact);
    caches_[robot].store(contacts_of(robot));
    solver_.finish(robots_[robot], k, caches_[robot]);
  }
}

/// Reports a contact to both robots, if the world moves them.
void BulletWorld::tell_contact(const SolverContact& contact, const Vec3& force, const Vec3& torque) {
  const ContactPoint& p = contact.point;
  if (p.gap > 0 && force.isZero(0)) return;
  const auto tell = [&](const Collider& self, const Collider& other, double sign) {
    if (self.robot < 0 || !robots_[std::size_t(self.robot)].is_dynamic()) return;
    multibody::RobotState& state = robots_[std::size_t(self.robot)].state();
    if (state.tells_contacts)
      state.contacts.push_back(
          {self.object, other.object, p.position, sign * p.normal, -p.gap, {sign * force, sign * torque}});
  };
  tell(*contact.a, *contact.b, 1);
  if (contact.b->robot != contact.a->robot) tell(*contact.b, *contact.a, -1);
}

void BulletWorld::export_contacts(double dt) {
  for (const SolverContact& contact : contacts_) {
    if (contact.row < 0) continue;
    const Vec3 force = contact.impulse / dt, torque = contact.angular_impulse / dt;
    const auto act = [&](const Collider& c, const Vec3& f, const Vec3& t) {
      if (c.robot < 0 || !robots_[std::size_t(c.robot)].is_dynamic()) return;
      BulletRobot& r = robots_[std::size_t(c.robot)];
      r.set_has_contact();
      Wrench& sum = r.state().contact[c.loaded_link];
      sum.add_force(f, contact.point.position - r.body_state(c.body).pose.position);
      sum.torque += t;
    };
    act(*contact.a, force, torque);
    act(*contact.b, -force, -torque);
    tell_contact(contact, force, torque);
  }
  for (BulletRobot& r : robots_)
    if (r.is_dynamic()) r.finish(settings_.gravity, dt);
}

}  // namespace muro::bullet
