// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/connector.hpp"

namespace muro {

/// A reference to a property in a scenario: "object:property", or "property" of an object that is searched for.
struct PropertyReference {
  std::string object;  ///< empty: the object is searched for
  std::string property;
};

/// Splits the text at its last colon. Either part may be empty.
PropertyReference read_reference(std::string_view text);

/// The objects of all robots, collected in one pass. An algorithm makes it once for all its searches. [setup]
class RobotObjects {
 public:
  explicit RobotObjects(const Connector& connector);
  /// Objects of a robot, in their order; `robot`: number of the robot.
  std::span<const ObjectId> of(std::uint32_t robot) const {
    return std::span(objects_).subspan(begins_[robot], begins_[robot + 1] - begins_[robot]);
  }

 private:
  std::vector<ObjectId> objects_;    ///< robot by robot
  std::vector<std::size_t> begins_;  ///< index of each robot's first object in `objects_`; then the end of the last one
};

/// Finds the properties that a scenario names, for one item. Does not find sums: they have no single value. [setup]
class PropertySearch {
 public:
  PropertySearch(const Connector& connector, const Item& item, const RobotObjects& of_robots);

  /// Objects in the order of search: the object of the item, the base of its robot, the other objects of the robot.
  std::span<const ObjectId> objects() const { return objects_; }
  /// Returns the properties that a name without an object can mean. The first of these places that has the property
  /// counts: the object of the item, the base, all other objects of the robot, the world.
  std::vector<FoundProperty> candidates(std::string_view property) const;
  std::optional<FoundProperty> property_of(ObjectId object, std::string_view property) const;
  /// Returns the measured value of a property, with the errors of the device: NAME.measured of the same object.
  std::optional<FoundProperty> measured(const FoundProperty& property) const;

  /// Returns the only candidate, or nothing when there is none. Throws Error when there are several. The error asks the
  /// user to choose one for `port` in `parameter` ("inputs").
  std::optional<FoundProperty> only(std::string_view property, std::string_view parameter, std::string_view port) const;
  /// Returns the property that a reference names. The object's name may be given with or without its robot. Throws
  /// Error that lists what exists; see only().
  FoundProperty find(const PropertyReference& reference, std::string_view parameter, std::string_view port) const;
  /// Works as find(), for a property that is to be written; see also target_velocity().
  FoundProperty find_output(const PropertyReference& reference, std::string_view parameter,
                            std::string_view port) const;
  /// Returns `joint.velocity.target` of a joint that has `joint.position.target`. The joint's motion reads it when
  /// something writes it. So it may be written although no object has it yet.
  std::optional<FoundProperty> target_velocity(ObjectId object, std::string_view property) const;

  std::vector<ObjectId> own_objects() const;  ///< objects of the item's robot, in the order of the scenario
  bool is_own(ObjectId object) const;         ///< whether it is one of these objects
  bool is_shadow(ObjectId object) const;      ///< whether it belongs to a robot that is a shadow
  /// Returns the kind of a joint, or of the joint that an encoder measures; `fixed` for other objects.
  JointKind joint_of(ObjectId object) const;

  std::string owner() const;                                 ///< "robot `rover_1`", "the world"
  std::string local_name(ObjectId object) const;             ///< name without the name of the robot: "base_link"
  std::string name_of(const FoundProperty& property) const;  ///< "`rover_1/base_link:twist`"

 private:
  ObjectId object(std::string_view name) const;

  const Connector& connector_;
  Item item_;
  std::vector<ObjectId> objects_;  ///< the objects after the first `preferred_` have equal rank
  std::size_t preferred_ = 0;
};

}  // namespace muro
