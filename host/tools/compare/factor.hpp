// SPDX-License-Identifier: MIT
// Factors of a comparison in a scenario, as in the design of experiments.
#pragma once

#include <string>
#include <vector>

#include "core/registry.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// One of the compared algorithms.
struct Choice {
  std::string label;  ///< "simplified", or the full id when it is of another family
  std::string use;    ///< "motion.simplified", or "off"
};

/// A subsystem or scene-wide algorithm and its choices: `rovers.motion=point,simplified`.
struct Factor {
  std::string name;         ///< "rovers.motion"
  std::string robots;       ///< the template; empty for an algorithm of the scene
  int first = 0, last = 0;  ///< robots of the template
  std::string subsystem;    ///< "motion", "collision"
  std::string path;         ///< path of the override: "robots.rovers.motion"
  std::string kind;         ///< "motion"
  std::vector<Choice> choices;
};

/// Reads the argument of --vary. Names of algorithms are short (`point` for a motion) or full ids. Throws SetupError
/// when there is no such subsystem or algorithm (with the nearest names), or when an algorithm is of another kind.
Factor read_factor(const std::string& text, const Scenario& scenario, const Registry& registry);

/// One choice of each factor.
struct Variation {
  std::string label;  ///< "point", "point + raycast"
  std::vector<const Choice*> choices;
  std::vector<std::string> overrides;  ///< for read_scenario
};

/// All variations; the choices of the last factor change fastest.
std::vector<Variation> all_variations(const std::vector<Factor>& factors);

}  // namespace muro::host
