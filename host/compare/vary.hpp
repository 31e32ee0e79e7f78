// SPDX-License-Identifier: MIT
// What a comparison changes in a scenario.
#pragma once

#include <string>
#include <vector>

#include "core/registry.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// One algorithm that may stand in a place.
struct Choice {
  std::string label;  ///< "simplified", or the whole id where it is of another family
  std::string use;    ///< "motion.simplified", or "off"
};

/// A place in the scenario and what shall stand there: `rovers.motion=point,simplified`.
struct Variety {
  std::string name;         ///< "rovers.motion"
  std::string robots;       ///< the template; empty for an algorithm of the scene
  int first = 0, last = 0;  ///< robots of the template
  std::string subsystem;    ///< "motion", "collision"
  std::string path;         ///< of the override: "robots.rovers.motion"
  std::string kind;         ///< "motion"
  std::vector<Choice> choices;
};

/// Reads the argument of --vary. Names of algorithms are short (`point` where a motion stands) or whole. Throws
/// SetupError: no such place, no such algorithm (with the nearest names), or one of another kind.
Variety read_vary(const std::string& text, const Scenario& scenario, const Registry& registry);

/// One choice of each.
struct Variation {
  std::string label;  ///< "point", "point + raycast"
  std::vector<const Choice*> choices;
  std::vector<std::string> overrides;  ///< for read_scenario
};

/// All of them, the choices of the last variety changing fastest.
std::vector<Variation> product(const std::vector<Variety>& varieties);

}  // namespace muro::host
