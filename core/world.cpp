// SPDX-License-Identifier: MIT
#include "core/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/value_check.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/random.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

World::World() {
  add_object("world");
  set(world_object, keys::gravity, Vec3(0, 0, -9.81));
}

ObjectId World::add_object(std::string_view name) {
  const ObjectId id{object_count()};
  check_object_name(name, "an object");
  if (!by_name_.emplace(std::string(name), id).second)
    throw SetupError("two objects are named `" + std::string(name) + "`; names are unique");
  store_.add_object(std::string(name));
  robot_of_.push_back(no_robot);
  return id;
}

ObjectId World::add_object(std::string_view name, RobotId robot) {
  const ObjectId id = add_object(name);
  robot_of_.back() = robot;
  robots_[index_of(robot)].objects.push_back(id);
  return id;
}

ObjectId World::add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> shapes) {
  return add_scenery(name, pose, shapes, shapes);
}

ObjectId World::add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> collisions,
                            std::span<const Shape> visuals) {
  const std::string object(name);
  check_values(object, keys::pose, &pose, 1);
  check_values(object, keys::collision_shapes, collisions.data(), std::uint32_t(collisions.size()));
  check_values(object, keys::visual_shapes, visuals.data(), std::uint32_t(visuals.size()));
  const ObjectId id = add_object(name);
  set(id, keys::pose, pose);
  if (!collisions.empty()) set_array(id, keys::collision_shapes, collisions);
  if (!visuals.empty()) set_array(id, keys::visual_shapes, visuals);
  return id;
}

namespace {

/// Calls `visit` with the place of every TextId in `size` bytes of values of a key.
template <class Bytes, class Visit>
void each_text(const KeyInfo& key, Bytes* data, std::size_t size, Visit visit) {
  const bool shape = key.type->name == ValueTraits<Shape>::name;
  if (!shape && key.type->name != ValueTraits<TextId>::name) return;
  for (std::size_t at = 0; at < size; at += key.type->size) {
    visit(data + at + (shape ? offsetof(Shape, mesh) : 0));
    if (shape) visit(data + at + offsetof(Shape, texture));
  }
}

/// Returns the number of a text that lies at `place`. Throws SetupError when it is of another world or model.
std::size_t number_of_text(const std::byte* place, std::size_t texts, const std::string& object, const KeyInfo& key) {
  TextId id;
  std::memcpy(&id, place, sizeof id);
  const auto number = static_cast<std::size_t>(id);
  if (number >= texts)
    throw SetupError(
        fmt::format("`{}:{}` names text {}, but there are {}; texts of shapes (mesh, texture) are interned with the "
                    "World or RobotTree that the shapes are given to",
                    object, key.name, number, texts));
  return number;
}

/// Returns the bytes of a constant with texts of the model replaced by texts of the world: `texts` translates.
std::vector<std::byte> with_texts(const RobotTree::Constant& c, const std::vector<TextId>& texts,
                                  const std::string& object) {
  std::vector<std::byte> data = c.data;
  each_text(c.key, data.data(), data.size(), [&](std::byte* place) {
    const TextId id = texts[number_of_text(place, texts.size(), object, c.key)];
    std::memcpy(place, &id, sizeof id);
  });
  return data;
}

}  // namespace

const RobotView& World::add_robot(std::string_view name, const RobotTree& tree, const Pose& start) {
  check_object_name(name, "a robot");
  check_values(std::string(name), keys::initial_pose, &start, 1);
  if (find_robot(name)) throw SetupError("two robots are named `" + std::string(name) + "`; names are unique");
  const RobotId id{std::uint32_t(robots_.size())};
  Robot& r = robots_.emplace_back();
  r.name = name;
  robot_by_name_.emplace(r.name, index_of(id));
  std::vector<TextId> texts;
  for (const std::string& t : tree.texts()) texts.push_back(intern(t));
  std::vector<ObjectId> objects;
  for (const RobotTree::Component& component : tree.components()) {
    objects.push_back(add_object(r.name + "/" + component.name, id));
    for (const RobotTree::Constant& c : component.constants) {
      const std::vector<std::byte> data = with_texts(c, texts, object_name(objects.back()));
      store_.set_constant(objects.back(), c.key, data.data(), c.count);
    }
  }
  for (const RobotTree::FlatLink& f : tree.links()) {
    Link link = f.link;
    link.object = objects[std::size_t(f.body)];
    link.joint_object = f.joint < 0 ? no_object : objects[std::size_t(f.joint)];
    r.links.push_back(link);
  }
  r.view = {r.name, id, fnv1a(r.name), r.links};
  robot_pointers_.push_back(&r.view);
  set(r.view.base(), keys::initial_pose, start);
  return r.view;
}

ObjectId World::find_object(std::string_view name) const {
  const auto it = by_name_.find(std::string(name));
  return it == by_name_.end() ? no_object : it->second;
}

ObjectId World::object(std::string_view name) const {
  const ObjectId id = find_object(name);
  if (id != no_object) return id;
  std::vector<std::string> names;
  for (const auto& [known, unused] : by_name_) names.push_back(known);
  std::sort(names.begin(), names.end());
  throw SetupError("no object is named `" + std::string(name) + "`" + did_you_mean(name, names));
}

const RobotView* World::find_robot(std::string_view name) const {
  const auto it = robot_by_name_.find(std::string(name));
  return it == robot_by_name_.end() ? nullptr : robot_pointers_[it->second];
}

void World::set_values(ObjectId object, const KeyInfo& key, const void* data, std::uint32_t count) {
  const std::uint32_t values = count == single_value ? 1 : count;
  check_values(object_name(object), key, data, values);
  each_text(key, static_cast<const std::byte*>(data), std::size_t(values) * key.type->size,
            [&](const std::byte* place) { number_of_text(place, text_count(), object_name(object), key); });
  store_.set_constant(object, key, data, count);
}

bool World::is_written(ObjectId object, std::string_view key) const {
  const Slot* s = store_.find(object, key);
  return s && s->writer();
}

bool World::is_used(ObjectId object, std::string_view key, Usage usage) const {
  const Slot* s = store_.find(object, key);
  return s && s->used_as(usage);
}

void* World::find_place(ObjectId object, const KeyInfo& key) const {
  const Slot* s = store_.find(object, key.name);
  return s && s->place && *store_.key_of(*s).type == *key.type ? s->place : nullptr;
}

void* World::place(ObjectId object, const KeyInfo& key) const {
  void* const found = find_place(object, key);
  if (!found) throw SetupError("`" + object_name(object) + "` has no property `" + std::string(key.name) + "`");
  return found;
}

ArrayHeader World::elements(ObjectId object, const KeyInfo& key) const {
  void* data = place(object, key);
  const Slot* s = store_.find(object, key.name);
  if (s->multiplicity == Multiplicity::list)
    return {static_cast<ListHeader*>(data)->data, static_cast<ListHeader*>(data)->size, key.type->size};
  return {data, s->count, key.type->size};
}

std::uint64_t World::hash(const RobotView& robot) const {
  std::vector<ObjectId> objects = robots_[index_of(robot.id)].objects;
  std::sort(objects.begin(), objects.end(), [&](ObjectId a, ObjectId b) { return object_name(a) < object_name(b); });
  std::uint64_t h = 0;
  for (const ObjectId o : objects) {
    const std::uint64_t of_object = store_.hash(o);
    h = hash_bytes(&of_object, sizeof of_object, h);
  }
  return h;
}

std::uint64_t World::hash_of_robots() const {
  std::uint64_t sum = 0;  // sum of hashes that contain the names: commutative, so it does not depend on the order
  for (const RobotView* r : robot_pointers_) sum += hash(*r);
  return sum;
}

std::uint64_t World::hash() const {
  std::uint64_t sum = hash_of_robots();
  for (std::uint32_t i = 0; i < object_count(); ++i)
    if (robot_of_[i] == no_robot) sum += store_.hash(ObjectId{i});
  return sum;
}

}  // namespace muro
