// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugins/controller/common/property_search/property_search.hpp"

namespace muro::sensors {

/// Finds the properties that the members of groups name. When all have connected. [setup]
class ReadingFinder {
 public:
  /// A property with its name for clients.
  using Found = std::pair<std::string, FoundProperty>;

  ReadingFinder(const Connector& connector, const Item& item, const RobotObjects& of_robots);

  /// "object:property" with * and ? on the robot itself, without its name ("laser:ranges"), or, where the robot has
  /// none such, on any object by its full name ("rover_1/base_link:pose"). "property" alone is that of any object of
  /// the robot, and where the object has a property.measured (the reading of the device), that one. In the order of
  /// objects. Throws Error.
  std::vector<Found> find(std::string_view member) const;

 private:
  std::vector<Found> find_measured(std::string_view property) const;
  std::vector<Found> all() const;

  const Connector& connector_;
  PropertySearch search_;
  std::vector<Found> own_;  ///< of the robot, by local names
};

}  // namespace muro::sensors
