// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "muro/connector.hpp"
#include "muro_controller.h"
#include "plugins/controller/common/property_search/property_search.hpp"

namespace muro::control {

/// Connections of a scenario, by port: "port=reference" or "port=reference,reference,...".
using Connections = std::map<std::string, std::vector<PropertyReference>, std::less<>>;

/// Reads the texts of parameter `parameter` ("inputs" or "outputs"). Only ports of `ports` are allowed. Throws Error.
Connections read_connections(std::string_view parameter, std::span<const std::string_view> texts,
                             std::span<const muro_port> ports, std::string_view library);

/// The property at one place of a port.
struct PortProperty {
  FoundProperty found;       ///< for a follower (a mimic joint): its joint, with the leader's key
  std::int32_t leader = -1;  ///< for a follower: place of its leader in the port; values for the follower are ignored
  double multiplier = 1, offset = 0;  ///< for a follower, as in Link
};

/// Whether a name matches a pattern; `*` matches any characters but "/".
bool matches(std::string_view pattern, std::string_view name);

/// Finds the properties of the ports of one item.
class PropertyFinder {
 public:
  PropertyFinder(const Connector& connector, const Item& item, const RobotObjects& of_robots)
      : connector_(connector), item_(item), search_(connector, item, of_robots) {}

  /// Returns the properties of a port, in order. Without a connection: the property of the name of the port, see
  /// PropertySearch; an input then prefers the reading of the device (NAME.measured). An output may name the target of
  /// a joint that follows another one, if it also names the target of the leader. Throws Error, which names candidates.
  std::vector<PortProperty> find(const muro_port& port, bool input, const Connections& connections) const;

  /// Whether there is a property that a port can mean by its name.
  bool has(std::string_view property) const { return !search_.candidates(property).empty(); }
  /// Returns the quoted name of the joint that the follower at this place of a port follows: "`LHipYawPitch`".
  std::string leader_of(const PortProperty& follower) const;

 private:
  struct Following {
    const RobotView* robot;
    const Link *link, *leader;
  };

  std::vector<FoundProperty> find_matching(const PropertyReference& reference, bool input) const;
  /// Returns the leader of a joint that follows another joint.
  std::optional<Following> following(ObjectId joint) const;
  std::optional<PortProperty> find_follower(const PropertyReference& reference) const;
  void find_leaders(std::vector<PortProperty>& all) const;
  void check(const FoundProperty& property, const muro_port& port, bool input, std::string_view unit) const;
  void check_unit(const FoundProperty& property, const muro_port& port, std::string_view unit) const;
  void check_type(const FoundProperty& property, const muro_port& port, bool input) const;

  const Connector& connector_;
  Item item_;
  PropertySearch search_;
};

}  // namespace muro::control
