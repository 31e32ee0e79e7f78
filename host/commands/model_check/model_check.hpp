// SPDX-License-Identifier: MIT
// A check of what the models of a scenario lack for the motions that move them: the text of `muro check`.
#pragma once

#include <string>
#include <vector>

#include "host/commands/model_check/model_facts.hpp"
#include "host/scenario/builder.hpp"

namespace muro::host {

/// A consequence of something that a model lacks.
struct Effect {
  std::string text;                  ///< "joints follow targets of position or velocity within limits, without forces"
  std::vector<std::string> motions;  ///< motions with this effect: "motion.ode"; empty: all

  bool operator==(const Effect&) const = default;
};

/// Something that a model lacks, or a motion leaves out.
struct Finding {
  std::string what;  ///< "no link that moves has mass: 6 links (...)"; may be empty
  std::vector<Effect> effects;
  std::string remedy;  ///< "Give the links `<inertial>`."; may be empty

  bool operator==(const Finding&) const = default;
};

/// Data of a motion that concern models.
struct CheckedMotion {
  std::string id;  ///< "motion.ode"
  Features features = 0;
  bool fixed_base = false;
  ModelFacts::Names held, freed;  ///< joints that nothing commands and the scenario leaves open; `freed`: with stops
};

/// Finds what a model lacks for one motion. `names`: number of names shown of each list.
std::vector<Finding> findings_of(const ModelFacts& facts, const CheckedMotion& motion, std::size_t names);

enum class Length {
  screen,  ///< about forty lines: only the first few of similar entries
  full,
};

/// Templates whose robots lack the same, in the order of the scenario, with their findings, and one line for all that
/// lack nothing. Robots without a motion are left out.
std::vector<std::string> check_lines(const BuiltScenario& built, Length length);

/// Returns "`a`, `b`, `c` and 4 more".
std::string first_of(const std::vector<std::string>& names, std::size_t most);

}  // namespace muro::host
