// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "muro/connector.hpp"
#include "muro_controller.h"
#include "plugins/common/property_search/property_search.hpp"

namespace muro::control {

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
  PropertyFinder(const Connector& connector, const Item& item) : connector_(connector), search_(connector, item) {}

  /// The properties of a port, in order. Without a connection: the property of the port's name, see PropertySearch;
  /// where there is a reading of the device (NAME.measured), an input gets that one. Throws Error, which names
  /// candidates.
  std::vector<FoundProperty> find(const muro_port& port, bool input, const Connections& connections) const;

  /// Whether anything that a port may stand for by its name has such a property.
  bool has(std::string_view property) const { return !search_.candidates(property).empty(); }

 private:
  std::vector<FoundProperty> find_matching(const PropertyReference& reference, bool input) const;
  void check(const FoundProperty& property, const muro_port& port, bool input) const;
  void check_unit(const FoundProperty& property, const muro_port& port) const;
  void check_type(const FoundProperty& property, const muro_port& port, bool input) const;

  const Connector& connector_;
  PropertySearch search_;
};

}  // namespace muro::control
