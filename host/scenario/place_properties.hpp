// SPDX-License-Identifier: MIT
#pragma once

#include "core/world.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

/// Stores the named places of a scenario on the world object, where algorithms find them.
inline void set_places(World& world, const Scenario& scenario) {
  std::vector<TextId> names;
  std::vector<double> numbers;
  for (const auto& [name, rectangles] : scenario.places)
    for (const Rectangle& r : rectangles) {
      names.push_back(world.intern(name));
      numbers.insert(numbers.end(), {r.x, r.y, r.width, r.depth});
    }
  if (names.empty()) return;
  world.set_array(world_object, keys::place_names, std::span<const TextId>(names));
  world.set_array(world_object, keys::place_rectangles, std::span<const double>(numbers));
}

}  // namespace muro::host
