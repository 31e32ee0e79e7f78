// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <unordered_map>

#include "core/property_store.hpp"
#include "core/robot_tree.hpp"
#include "core/text_table.hpp"
#include "muro/shape.hpp"

namespace muro {

/// Everything that is simulated: objects, robots and their properties. Object 0 is the world itself.
class World {
 public:
  World();

  /// Adds an object. Throws SetupError when the name is taken, or is not allowed: see check_object_name. [setup]
  ObjectId add_object(std::string_view name);
  /// An object of a robot that its model does not have, such as a sensor. [setup]
  ObjectId add_object(std::string_view name, RobotId robot);
  /// Scenery: a body that does not move. Throws SetupError when its pose or shapes are out of range
  /// (muro/base/limits.hpp). [setup]
  ObjectId add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> shapes);
  /// Adds scenery whose visual shapes differ from its collision shapes. [setup]
  ObjectId add_scenery(std::string_view name, const Pose& pose, std::span<const Shape> collisions,
                       std::span<const Shape> visuals);
  /// Adds a robot "name" with an object "name/component" for every component of the tree. Throws SetupError when the
  /// pose is out of range. [setup]
  const RobotView& add_robot(std::string_view name, const RobotTree& tree, const Pose& start = {});

  ObjectId find_object(std::string_view name) const;
  /// Returns the object of this name. Throws SetupError with the nearest name when there is none.
  ObjectId object(std::string_view name) const;
  std::uint32_t object_count() const { return std::uint32_t(robot_of_.size()); }
  const std::string& object_name(ObjectId id) const { return store_.object_name(id); }
  RobotId robot_of(ObjectId id) const { return robot_of_[index_of(id)]; }
  /// All objects of a robot: those of its model, then sensors and the like.
  const std::vector<ObjectId>& objects_of(const RobotView& robot) const { return robots_[index_of(robot.id)].objects; }
  std::span<const RobotView* const> robots() const { return robot_pointers_; }
  const RobotView* find_robot(std::string_view name) const;

  TextId intern(std::string_view text) { return texts_.intern(text); }
  std::string_view text(TextId id) const { return texts_[id]; }
  std::size_t text_count() const { return texts_.size(); }

  PropertyStore& store() { return store_; }
  const PropertyStore& store() const { return store_; }

  /// Sets a constant. Throws SetupError when the value is out of range (muro/base/limits.hpp). [setup]
  template <class T>
  void set(ObjectId object, const Key<T>& key, const T& value) {
    set_values(object, key, &value, single_value);
  }
  template <class T>
  void set_array(ObjectId object, const Key<T>& key, std::span<const T> values) {
    set_values(object, key, values.data(), std::uint32_t(values.size()));
  }
  template <class T, class U>
  void share(ObjectId a, const Key<T>& key_a, ObjectId b, const Key<U>& key_b) {
    store_.share(a, key_a, b, key_b);
  }
  /// The present value of a single property; throws SetupError when there is none of this type. A value that is derived
  /// on demand dates from the last run of an algorithm that reads it: see Simulation::refresh.
  template <class T>
  T& value(ObjectId object, const Key<T>& key) const {
    return *static_cast<T*>(place(object, key));
  }
  template <class T>
  T& value(std::string_view name, const Key<T>& key) const {
    return value(object(name), key);
  }
  /// The present elements of an array or list.
  template <class T>
  std::span<T> values(ObjectId object, const Key<T>& key) const {
    const ArrayHeader found = elements(object, key);
    return {static_cast<T*>(found.data), found.size};
  }

  /// The present value of a single property; null when there is none of this type.
  template <class T>
  T* find_value(ObjectId object, const Key<T>& key) const {
    return static_cast<T*>(find_place(object, key));
  }
  /// Returns the present value of a single property, or `default_value` when there is none of this type.
  template <class T>
  T value(ObjectId object, const Key<T>& key, const T& default_value) const {
    const T* const found = find_value(object, key);
    return found ? *found : default_value;
  }
  /// Whether an object has a property of this name: an algorithm or the set-up creates it, or asks for it.
  bool has(ObjectId object, std::string_view key) const { return store_.find(object, key) != nullptr; }
  /// Whether an algorithm writes it.
  bool is_written(ObjectId object, std::string_view key) const;
  /// Whether an algorithm uses it in this way.
  bool is_used(ObjectId object, std::string_view key, Usage usage) const;

  /// A constant that is a single value; null when there is none.
  template <class T>
  const T* find_constant(ObjectId object, const Key<T>& key) const {
    return static_cast<const T*>(store_.constant(object, key).data);
  }
  /// A constant that is a single value, or `default_value`.
  template <class T>
  T constant(ObjectId object, const Key<T>& key, const T& default_value) const {
    const T* const found = find_constant(object, key);
    return found ? *found : default_value;
  }
  /// The elements of a constant array; none when there is no such constant.
  template <class T>
  std::span<const T> constants(ObjectId object, const Key<T>& key) const {
    const ArrayHeader found = store_.constant(object, key);
    return {static_cast<const T*>(found.data), found.data ? found.size : 0};
  }

  /// Hash of the variable properties of a robot's objects; does not depend on other robots.
  std::uint64_t hash(const RobotView& robot) const;
  /// Hash of the variable properties of all robots; other objects, such as a camera that looks on, do not count.
  std::uint64_t hash_of_robots() const;
  /// Hash of all variable properties; does not depend on the order in which robots were declared.
  std::uint64_t hash() const;

 private:
  void set_values(ObjectId object, const KeyInfo& key, const void* data, std::uint32_t count);
  void* find_place(ObjectId object, const KeyInfo& key) const;
  void* place(ObjectId object, const KeyInfo& key) const;
  ArrayHeader elements(ObjectId object, const KeyInfo& key) const;

  PropertyStore store_;
  std::vector<RobotId> robot_of_;
  std::unordered_map<std::string, ObjectId> by_name_;
  struct Robot {
    std::string name;
    std::vector<Link> links;
    RobotView view;
    std::vector<ObjectId> objects;
  };
  std::deque<Robot> robots_;
  std::unordered_map<std::string, std::uint32_t> robot_by_name_;
  std::vector<const RobotView*> robot_pointers_;
  TextTable texts_;
};

}  // namespace muro
