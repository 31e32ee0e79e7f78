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

/// What a scenario says about ports: "port=reference" or "port=reference,reference,...", by port.
using Connections = std::map<std::string, std::vector<PropertyReference>, std::less<>>;

/// Reads the texts of parameter `parameter` ("inputs" or "outputs"); names only ports of `ports`. Throws Error.
Connections read_connections(std::string_view parameter, std::span<const std::string_view> texts,
                             std::span<const muro_port> ports, std::string_view library);

/// What stands at one place of a port.
struct PortProperty {
  FoundProperty found;  ///< of a joint that follows another one (a mimic joint): its, with the key of the leader's
  std::int32_t leader =
      -1;  ///< of such a joint: the place in the port of what moves it; what comes for it goes nowhere
  double multiplier = 1, offset = 0;  ///< of such a joint, as Link has them
};

/// Whether a name fits a pattern, in which `*` stands for any characters but "/".
bool matches(std::string_view pattern, std::string_view name);

/// Finds what the ports of one item stand for.
class PropertyFinder {
 public:
  PropertyFinder(const Connector& connector, const Item& item, const RobotObjects& of_robots)
      : connector_(connector), item_(item), search_(connector, item, of_robots) {}

  /// The properties of a port, in order. Without a connection: the property of the port's name, see PropertySearch;
  /// where there is a reading of the device (NAME.measured), an input gets that one. An output may name the target of
  /// a joint that follows another one, where it names that of its leader, too. Throws Error, which names candidates.
  std::vector<PortProperty> find(const muro_port& port, bool input, const Connections& connections) const;

  /// Whether anything that a port may stand for by its name has such a property.
  bool has(std::string_view property) const { return !search_.candidates(property).empty(); }
  /// "`LHipYawPitch`", of what the joint at this place of a port follows.
  std::string leader_of(const PortProperty& follower) const;

 private:
  struct Following {
    const RobotView* robot;
    const Link *link, *leader;
  };

  std::vector<FoundProperty> find_matching(const PropertyReference& reference, bool input) const;
  /// Of a joint that follows another one.
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
