// SPDX-License-Identifier: MIT
#include "host/tools/compare/contact_monitor.hpp"

#include <algorithm>

#include "core/instance.hpp"
#include "host/scenario/defaults.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr std::uint32_t scenery_bit = 1u << 31;  ///< marks an object of the scenery in a pair

const Pose* pose_of(const World& world, ObjectId object) { return world.find_value(object, keys::pose); }

}  // namespace

ContactMonitor::ContactMonitor(Simulation& monitored, const std::vector<std::uint32_t>& robots,
                               const std::vector<Subsystem>& algorithms)
    : monitored_(monitored), scene_(monitored.registry()) {
  const World& world = monitored.world();
  counts_.assign(world.robots().size(), false);
  for (const std::uint32_t r : robots) {
    counts_[r] = world.is_used(world.robots()[r]->base(), keys::external_wrench.name, usage::read_sum);
    active_ = active_ || counts_[r];
  }
  if (!active_) return;
  scene_.set_log([](LogLevel, std::string_view) {});  // the monitored scene has already logged it
  add_scenery();
  add_bodies();
  add_collision_detection(algorithms);
  scene_.build();
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    bodies_[b].copy = &scene_.world().value(scene_.world().robots()[b]->base(), keys::pose);
  for (const Kind kind : {Kind::scene, Kind::collision})
    for (std::size_t i = 0; i < scene_.instances().size(); ++i)
      if (scene_.instances()[i]->description().kind == kind) tasks_.push_back(scene_.task_of(i));
}

/// Returns a collision shape of the monitored scene for `owner`, the World or RobotTree that gets it. Solvers hold
/// bodies a little apart, or let them overlap; so shapes of robots are enlarged on all sides.
template <class Owner>
Shape ContactMonitor::copy_of(Shape shape, double grown_by, Owner& owner) const {
  shape.texture = no_text;
  switch (shape.kind) {
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      shape.mesh = owner.intern(monitored_.world().text(shape.mesh));
      break;
    case ShapeKind::box:
      shape.size += Vec3::Constant(2 * grown_by);
      break;
    case ShapeKind::cylinder:
      shape.size += Vec3(grown_by, 0, 2 * grown_by);
      break;
    default:
      shape.size.x() += grown_by;
  }
  return shape;
}

void ContactMonitor::add_scenery() {
  const World& world = monitored_.world();
  for (std::uint32_t i = 0; i < world.object_count(); ++i) {
    const Pose* pose = world.robot_of(ObjectId{i}) == no_robot ? pose_of(world, ObjectId{i}) : nullptr;
    std::vector<Shape> shapes;
    for (const Shape& s : world.constants(ObjectId{i}, keys::collision_shapes))
      if (s.kind != ShapeKind::plane) shapes.push_back(copy_of(s, 0, scene_.world()));
    if (pose && !shapes.empty()) scene_.world().add_scenery(world.object_name(ObjectId{i}), *pose, shapes);
  }
}

/// The copy of each body is a robot of its own, so that it can be moved to the pose of the original.
void ContactMonitor::add_bodies() {
  const World& world = monitored_.world();
  for (const RobotView* r : world.robots()) {
    if (world.find_constant(r->base(), keys::shadow_of)) continue;
    for (const Link& link : r->links) {
      RobotTree tree;
      std::vector<Shape> shapes;
      for (const Shape& s : world.constants(link.object, keys::collision_shapes))
        shapes.push_back(copy_of(s, margin, tree));
      const Pose* pose = pose_of(world, link.object);
      if (shapes.empty() || !pose) continue;
      tree.base("body");
      tree.set(keys::inertial, Inertia{.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
      tree.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
      tree.close();
      const RobotView& copy = scene_.world().add_robot(world.object_name(link.object) + ".copy", tree, *pose);
      scene_.use("motion.simplified", 1000, {{&copy, copy.base()}});
      bodies_.push_back({index_of(r->id), pose});
    }
  }
}

void ContactMonitor::add_collision_detection(const std::vector<Subsystem>& algorithms) {
  for (const auto& [kind, default_name] : {std::pair(Kind::scene, "index"), std::pair(Kind::collision, "collision")}) {
    const auto named = std::find_if(algorithms.begin(), algorithms.end(), [&, k = kind](const Subsystem& s) {
      return scene_.registry().find(s.use).kind == name_of(k);
    });
    const auto* const standard =
        std::find_if(std::begin(default_algorithms), std::end(default_algorithms),
                     [&, n = default_name](const DefaultAlgorithm& d) { return d.name == std::string(n); });
    if (named != algorithms.end())
      scene_.use(named->use, 0, {}, named->parameters);
    else
      scene_.use(standard->use, 0);
  }
}

void ContactMonitor::add_contact(const Pair& pair, double now) {
  if (!updated_) initial_contacts_.insert(pair);
  if (initial_contacts_.count(pair) > 0) return;
  const auto last = last_contact_.find(pair);
  if (last == last_contact_.end() || now - last->second > separation) {
    ++contacts_;
    if (!first_contact_) first_contact_ = now;
  }
  last_contact_[pair] = now;
}

void ContactMonitor::add_contact(std::uint32_t body, const Contact& contact, double now) {
  const std::uint32_t robot = bodies_[body].robot;
  const RobotId other_body = scene_.world().robot_of(contact.other);
  if (!counts_[robot]) return;
  if (other_body == no_robot) return add_contact({robot, scenery_bit | index_of(contact.other)}, now);
  const std::uint32_t other = bodies_[index_of(other_body)].robot;
  if (other == robot) return;
  // a pair of robots is in the contact lists of both
  add_contact(counts_[other] ? Pair{std::min(robot, other), std::max(robot, other)} : Pair{robot, other}, now);
}

void ContactMonitor::update() {
  if (!active_) return;
  monitored_.refresh();
  for (const Body& b : bodies_) *b.copy = *b.monitored;
  scene_.scheduler().run_extra(tasks_);
  const double now = 1e-9 * double(monitored_.now());
  const World& world = scene_.world();
  for (const RobotView* r : world.robots())
    for (const Contact& c : world.values(r->base(), keys::contacts)) add_contact(index_of(r->id), c, now);
  updated_ = true;
}

}  // namespace muro::host
