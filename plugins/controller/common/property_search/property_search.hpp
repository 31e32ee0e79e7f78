// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/connector.hpp"

namespace muro {

/// How a scenario refers to a property: "object:property", or "property" of an object that is searched for.
struct PropertyReference {
  std::string object;  ///< empty: it is searched for
  std::string property;
};

/// Either part may be empty.
PropertyReference read_reference(std::string_view text);

/// The objects of all robots, found in one pass, once for the searches of an algorithm. [setup]
class RobotObjects {
 public:
  explicit RobotObjects(const Connector& connector);
  /// Of a robot, in their order; `robot`: its number.
  std::span<const ObjectId> of(std::uint32_t robot) const {
    return std::span(objects_).subspan(begins_[robot], begins_[robot + 1] - begins_[robot]);
  }

 private:
  std::vector<ObjectId> objects_;    ///< robot by robot
  std::vector<std::size_t> begins_;  ///< of each robot, in these; and the end of the last
};

/// Finds the properties that a scenario names, for one item. Sums, which have no single value, are not found. [setup]
class PropertySearch {
 public:
  PropertySearch(const Connector& connector, const Item& item, const RobotObjects& of_robots);

  /// The object of the item, the base of its robot, the other objects of the robot: the order of search.
  std::span<const ObjectId> objects() const { return objects_; }
  /// What a property may stand for that is named alone: that of the item's object, else that of the base, else those
  /// of all other objects of the robot, else that of the world.
  std::vector<FoundProperty> candidates(std::string_view property) const;
  std::optional<FoundProperty> property_of(ObjectId object, std::string_view property) const;
  /// What a device reads of a property, errors included: NAME.measured of the same object.
  std::optional<FoundProperty> measured(const FoundProperty& property) const;

  /// The only candidate; nothing where there is none. Throws Error where there are several: one is to be chosen in
  /// `parameter` ("inputs") for what is called `port` there.
  std::optional<FoundProperty> only(std::string_view property, std::string_view parameter, std::string_view port) const;
  /// What a reference stands for, which names an object with or without its robot. Throws Error, which says what there
  /// is; see only().
  FoundProperty find(const PropertyReference& reference, std::string_view parameter, std::string_view port) const;
  /// The same for what is to be written: see also target_velocity().
  FoundProperty find_output(const PropertyReference& reference, std::string_view parameter,
                            std::string_view port) const;
  /// `joint.velocity.target` of a joint that follows `joint.position.target`: its motion takes it where something
  /// writes it, so it may be written though nobody has it yet.
  std::optional<FoundProperty> target_velocity(ObjectId object, std::string_view property) const;

  std::vector<ObjectId> own_objects() const;  ///< of the robot of the item, in the order of the scenario
  bool is_own(ObjectId object) const;         ///< one of these
  bool is_shadow(ObjectId object) const;      ///< of a robot that is a shadow
  /// Of a joint, and of what an encoder looks at; `fixed` for what is neither.
  JointKind joint_of(ObjectId object) const;

  std::string owner() const;                                 ///< "robot `rover_1`", "the world"
  std::string local_name(ObjectId object) const;             ///< without that of the robot: "base_link"
  std::string name_of(const FoundProperty& property) const;  ///< "`rover_1/base_link:twist`"

 private:
  ObjectId object(std::string_view name) const;

  const Connector& connector_;
  Item item_;
  std::vector<ObjectId> objects_;  ///< all after the first `preferred_` are equal
  std::size_t preferred_ = 0;
};

}  // namespace muro
