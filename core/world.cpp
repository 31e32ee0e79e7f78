// SPDX-License-Identifier: MIT
#include "core/world.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/toolkit/random.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

World::World() {
  add_object("world");
  set(world_object, keys::gravity, Vec3(0, 0, -9.81));
}

ObjectId World::add_object(std::string_view name) {
  const ObjectId id{object_count()};
  if (name.empty()) throw SetupError("an object has no name");
  if (!by_name_.emplace(std::string(name), id).second)
    throw SetupError("two objects are named `" + std::string(name) + "`; names are unique");
  store_.add_object(std::string(name));
  robot_of_.push_back(-1);
  return id;
}

ObjectId World::add_object(std::string_view name, std::uint32_t robot) {
  const ObjectId id = add_object(name);
  robot_of_.back() = std::int32_t(robot);
  robots_[robot].objects.push_back(id);
  return id;
}

ObjectId World::add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> shapes) {
  return add_scenery(name, pose, shapes, shapes);
}

ObjectId World::add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> collisions,
                            std::span<const Shape> visuals) {
  const ObjectId id = add_object(name);
  set(id, keys::pose, pose);
  if (!collisions.empty()) set_array(id, keys::collision_shapes, collisions);
  if (!visuals.empty()) set_array(id, keys::visual_shapes, visuals);
  return id;
}

namespace {

/// The bytes of a constant in which texts of the model are texts of the world: `texts` translates.
std::vector<std::byte> with_texts(const RobotTree::Constant& c, const std::vector<TextId>& texts) {
  std::vector<std::byte> data = c.data;
  const bool shape = c.key.type->name == ValueTraits<Shape>::name;
  if (!shape && c.key.type->name != ValueTraits<TextId>::name) return data;
  const auto translate = [&](std::size_t offset) {
    for (std::size_t at = offset; at < data.size(); at += c.key.type->size) {
      TextId id;
      std::memcpy(&id, data.data() + at, sizeof id);
      id = texts[static_cast<std::size_t>(id)];
      std::memcpy(data.data() + at, &id, sizeof id);
    }
  };
  translate(shape ? offsetof(Shape, mesh) : 0);
  if (shape) translate(offsetof(Shape, texture));
  return data;
}

}  // namespace

const RobotView& World::add_robot(std::string_view name, const RobotTree& tree, const Pose& start) {
  if (find_robot(name)) throw SetupError("two robots are named `" + std::string(name) + "`; names are unique");
  const auto number = std::uint32_t(robots_.size());
  Robot& r = robots_.emplace_back();
  r.name = name;
  robot_by_name_.emplace(r.name, number);
  std::vector<TextId> texts;
  for (const std::string& t : tree.texts()) texts.push_back(intern(t));
  std::vector<ObjectId> objects;
  for (const RobotTree::Component& component : tree.components()) {
    objects.push_back(add_object(r.name + "/" + component.name, number));
    for (const RobotTree::Constant& c : component.constants) {
      const std::vector<std::byte> data = with_texts(c, texts);
      store_.set_constant(objects.back(), c.key, data.data(), c.count);
    }
  }
  for (const RobotTree::FlatLink& f : tree.links()) {
    Link link = f.link;
    link.object = objects[std::size_t(f.body)];
    link.joint_object = f.joint < 0 ? no_object : objects[std::size_t(f.joint)];
    r.links.push_back(link);
  }
  r.view = {r.name, number, fnv1a(r.name), r.links};
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

TextId World::intern(std::string_view text) {
  const auto it = std::find(texts_.begin(), texts_.end(), text);
  if (it != texts_.end()) return TextId(it - texts_.begin());
  texts_.emplace_back(text);
  return TextId(texts_.size() - 1);
}

void* World::place(ObjectId object, const KeyInfo& key) const {
  const Slot* s = store_.find(object, key.name);
  if (!s || !s->place || !(*store_.key_of(*s).type == *key.type))
    throw SetupError("`" + object_name(object) + "` has no property `" + std::string(key.name) + "`");
  return s->place;
}

ArrayHeader World::elements(ObjectId object, const KeyInfo& key) const {
  void* data = place(object, key);
  const Slot* s = store_.find(object, key.name);
  if (s->multiplicity == Multiplicity::list)
    return {static_cast<ListHeader*>(data)->data, static_cast<ListHeader*>(data)->size};
  return {data, s->count};
}

std::uint64_t World::hash(const RobotView& robot) const {
  std::vector<ObjectId> objects = robots_[robot.number].objects;
  std::sort(objects.begin(), objects.end(), [&](ObjectId a, ObjectId b) { return object_name(a) < object_name(b); });
  std::uint64_t h = 0;
  for (const ObjectId o : objects) {
    const std::uint64_t of_object = store_.hash(o);
    h = hash_bytes(&of_object, sizeof of_object, h);
  }
  return h;
}

std::uint64_t World::hash() const {
  std::uint64_t sum = 0;  // of hashes that contain the names: commutative, so independent of the order
  for (const RobotView* r : robot_pointers_) sum += hash(*r);
  for (std::uint32_t i = 0; i < object_count(); ++i)
    if (robot_of_[i] < 0) sum += store_.hash(ObjectId{i});
  return sum;
}

}  // namespace muro
