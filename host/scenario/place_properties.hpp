// SPDX-License-Identifier: MIT
#pragma once

#include "core/world.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Leaves the named places of a scenario on the world object, where algorithms find them
/// (plugins/common/level_rules/place_keys.hpp).
inline void set_places(World& world, const Scenario& scenario) {
  constexpr Key<TextId> place_names{"place.names", "1", "name of the place to which each rectangle belongs"};
  constexpr Key<double> place_rectangles{"place.rectangles", "m",
                                         "for each rectangle: x and y of its centre, lengths along x and y"};
  std::vector<TextId> names;
  std::vector<double> numbers;
  for (const auto& [name, rectangles] : scenario.places)
    for (const Rectangle& r : rectangles) {
      names.push_back(world.intern(name));
      numbers.insert(numbers.end(), {r.x, r.y, r.width, r.depth});
    }
  if (names.empty()) return;
  world.set_array(world_object, place_names, std::span<const TextId>(names));
  world.set_array(world_object, place_rectangles, std::span<const double>(numbers));
}

}  // namespace muro::host
