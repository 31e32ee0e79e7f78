// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "muro/connector.hpp"
#include "muro_controller.h"

namespace muro::control {

/// How a scenario refers to a property: "object:property", or "property" of an object that is searched for.
struct PropertyReference {
  std::string object;  ///< empty: it is searched for; with a `*`: all objects of such names
  std::string property;
};

/// What a scenario says about ports: "port=reference" or "port=reference,reference,...", by port.
using Connections = std::map<std::string, std::vector<PropertyReference>, std::less<>>;

/// Reads the texts of parameter `parameter` ("inputs" or "outputs"); names only ports of `ports`. Throws Error.
Connections read_connections(std::string_view parameter, std::span<const std::string_view> texts,
                             std::span<const muro_port> ports, std::string_view library);

/// Whether a name fits a pattern, in which `*` stands for any characters but "/".
bool matches(std::string_view pattern, std::string_view name);

/// Finds what the ports of one item stand for.
class PropertyFinder {
 public:
  PropertyFinder(const Connector& connector, const Item& item);

  /// The properties of a port, in order. Without a connection: the property of the port's name on the object of the
  /// item, else on the robot's base, else on the only other object of the robot that has it, else on the world; where
  /// that object has a property NAME.measured (the reading of the device, errors included), an input gets that one.
  /// Throws Error, which names candidates.
  std::vector<FoundProperty> find(const muro_port& port, bool input, const Connections& connections) const;

  /// Whether anything that a port may stand for by its name has such a property.
  bool has(std::string_view property) const;

 private:
  FoundProperty find(const PropertyReference& reference, std::string_view parameter, std::string_view port) const;
  std::vector<FoundProperty> find_matching(const PropertyReference& reference) const;
  FoundProperty find_anywhere(std::string_view property, std::string_view parameter, std::string_view port) const;
  ObjectId object(std::string_view name) const;
  const FoundProperty* property_of(ObjectId object, std::string_view name) const;
  void check(const FoundProperty& property, const muro_port& port, bool input) const;
  void check_unit(const FoundProperty& property, const muro_port& port) const;
  void check_type(const FoundProperty& property, const muro_port& port, bool input) const;
  JointKind joint_of(ObjectId object) const;
  bool is_shadow(ObjectId object) const;
  std::string local_name(ObjectId object) const;
  std::string full_name(const FoundProperty& property) const;
  std::string robot_or_world() const;

  const Connector& connector_;
  Item item_;
  std::vector<ObjectId> objects_;  ///< in the order of search; all after the first `preferred_` are equal
  std::size_t preferred_ = 0;
};

}  // namespace muro::control
