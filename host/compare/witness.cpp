// SPDX-License-Identifier: MIT
#include "host/compare/witness.hpp"

#include <algorithm>

#include "core/instance.hpp"
#include "host/constants.hpp"
#include "host/scenario/defaults.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr std::uint32_t scenery = 1u << 31;  ///< marks objects among the second of a pair

const Pose* pose_of(const World& world, ObjectId object) {
  const Slot* slot = world.store().find(object, keys::pose.name);
  return slot ? static_cast<const Pose*>(slot->place) : nullptr;
}

}  // namespace

Witness::Witness(Simulation& watched, const std::vector<std::uint32_t>& robots,
                 const std::vector<Subsystem>& algorithms)
    : watched_(watched), scene_(watched.registry()) {
  const World& world = watched.world();
  counted_.assign(world.robots().size(), false);
  for (const std::uint32_t r : robots) {
    const Slot* slot = world.store().find(world.robots()[r]->base(), keys::external_wrench.name);
    counted_[r] = slot && slot->used_as(usage::read_sum);
    any_ = any_ || counted_[r];
  }
  if (!any_) return;
  scene_.set_log([](LogLevel, std::string_view) {});  // the scene that is watched has said it
  add_scenery();
  add_bodies();
  use_collision(algorithms);
  scene_.build();
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    bodies_[b].to = &scene_.world().value(scene_.world().robots()[b]->base(), keys::pose);
  for (const Kind kind : {Kind::scene, Kind::collision})
    for (std::size_t i = 0; i < scene_.instances().size(); ++i)
      if (scene_.instances()[i]->description().kind == kind) tasks_.push_back(scene_.task_of(i));
}

/// Solvers hold bodies a little apart, or let them overlap; so `more` is added on all sides.
Shape Witness::shape_of(Shape shape, double more) {
  switch (shape.kind) {
    case ShapeKind::mesh:
      shape.mesh = scene_.world().intern(watched_.world().text(shape.mesh));
      break;
    case ShapeKind::box:
      shape.size += Vec3::Constant(2 * more);
      break;
    case ShapeKind::cylinder:
      shape.size += Vec3(more, 0, 2 * more);
      break;
    default:
      shape.size.x() += more;
  }
  return shape;
}

/// Pairs of robots and objects are told by the number of the object in this scene.
void Witness::add_scenery() {
  const World& world = watched_.world();
  for (std::uint32_t i = 0; i < world.object_count(); ++i) {
    const Pose* pose = world.robot_of(ObjectId{i}) < 0 ? pose_of(world, ObjectId{i}) : nullptr;
    std::vector<Shape> shapes;
    for (const Shape& s : constants(world, ObjectId{i}, keys::collision_shapes))
      if (s.kind != ShapeKind::plane) shapes.push_back(shape_of(s, 0));
    if (pose && !shapes.empty()) scene_.world().add_scenery(world.object_name(ObjectId{i}), *pose, shapes);
  }
}

/// Each body is a robot here, so that it can be put where it is.
void Witness::add_bodies() {
  const World& world = watched_.world();
  for (const RobotView* r : world.robots()) {
    if (world.store().constant(r->base(), keys::shadow_of).data) continue;
    for (const Link& f : r->links) {
      std::vector<Shape> shapes;
      for (const Shape& s : constants(world, f.object, keys::collision_shapes)) shapes.push_back(shape_of(s, reach));
      const Pose* pose = pose_of(world, f.object);
      if (shapes.empty() || !pose) continue;
      RobotTree tree;
      tree.base("body");
      tree.set(keys::inertial, Inertia{.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
      tree.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
      tree.close();
      const RobotView& body = scene_.world().add_robot(world.object_name(f.object) + ".seen", tree, *pose);
      scene_.use("motion.simplified", 1000, {{&body, body.base()}});
      bodies_.push_back({r->number, pose});
    }
  }
}

void Witness::use_collision(const std::vector<Subsystem>& algorithms) {
  for (const auto& [kind, otherwise] : {std::pair(Kind::scene, "index"), std::pair(Kind::collision, "collision")}) {
    const auto named = std::find_if(algorithms.begin(), algorithms.end(), [&, k = kind](const Subsystem& s) {
      return scene_.registry().find(s.use).kind == name_of(k);
    });
    const auto* const standard =
        std::find_if(std::begin(defaults), std::end(defaults),
                     [&, n = otherwise](const Default& d) { return d.name == std::string(n); });
    if (named != algorithms.end())
      scene_.use(named->use, 0, {}, named->parameters);
    else
      scene_.use(standard->use, 0);
  }
}

void Witness::touch(const Pair& pair, double now) {
  if (!looked_) stands_.insert(pair);
  if (stands_.count(pair) > 0) return;
  const auto before = seen_.find(pair);
  if (before == seen_.end() || now - before->second > pause) {
    ++begins_;
    if (!first_) first_ = now;
  }
  seen_[pair] = now;
}

void Witness::meet(std::uint32_t body, const Contact& contact, double now) {
  const std::uint32_t robot = bodies_[body].robot;
  const std::int32_t other_body = scene_.world().robot_of(contact.other);
  if (!counted_[robot]) return;
  if (other_body < 0) return touch({robot, scenery | index_of(contact.other)}, now);
  const std::uint32_t other = bodies_[std::size_t(other_body)].robot;
  if (other == robot) return;
  // a pair of robots stands in the lists of both
  touch(counted_[other] ? Pair{std::min(robot, other), std::max(robot, other)} : Pair{robot, other}, now);
}

void Witness::look() {
  if (!any_) return;
  watched_.refresh();
  for (const Body& b : bodies_) *b.to = *b.from;
  scene_.scheduler().run_extra(tasks_);
  const double now = 1e-9 * double(watched_.now());
  const World& world = scene_.world();
  for (const RobotView* r : world.robots())
    for (const Contact& c : world.values(r->base(), keys::contacts)) meet(r->number, c, now);
  looked_ = true;
}

}  // namespace muro::host
