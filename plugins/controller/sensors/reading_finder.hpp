// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugins/controller/common/property_search/property_search.hpp"

namespace muro::sensors {

/// Finds the properties that the members of groups name. Used after all algorithms have connected. [setup]
class ReadingFinder {
 public:
  /// A property with its name for clients.
  using Found = std::pair<std::string, FoundProperty>;

  ReadingFinder(const Connector& connector, const Item& item, const RobotObjects& of_robots);

  /// Returns the properties that `member` names, in the order of objects. "object:property", with * and ?, means
  /// objects of the robot by their local names ("laser:ranges"). If none matches, it means any object by its full name
  /// ("rover_1/base_link:pose"). "property" alone means that property of all objects of the robot. An object that has
  /// property.measured (the reading of the device) gives this one instead. Throws Error.
  std::vector<Found> find(std::string_view member) const;

 private:
  std::vector<Found> find_measured(std::string_view property) const;
  std::vector<Found> all() const;

  const Connector& connector_;
  PropertySearch search_;
  std::vector<Found> own_;  ///< properties of the robot, by local names
};

}  // namespace muro::sensors
