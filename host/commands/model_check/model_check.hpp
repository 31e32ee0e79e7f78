// SPDX-License-Identifier: MIT
// What the models of a scenario lack for the motions that move them: the text of `muro check`.
#pragma once

#include <string>
#include <vector>

#include "host/commands/model_check/model_facts.hpp"
#include "host/scenario/builder.hpp"

namespace muro::host {

/// What follows from something that a model lacks.
struct Effect {
  std::string text;                  ///< "joints follow targets of position or velocity within limits, without forces"
  std::vector<std::string> motions;  ///< where it does: "motion.ode"; none: with any

  bool operator==(const Effect&) const = default;
};

/// Something that a model lacks, or a motion leaves out.
struct Finding {
  std::string what;  ///< "no link that moves has mass: 6 links (...)"; may be empty
  std::vector<Effect> effects;
  std::string remedy;  ///< "Give the links `<inertial>`."; may be empty

  bool operator==(const Finding&) const = default;
};

/// A motion as far as models concern it.
struct CheckedMotion {
  std::string id;  ///< "motion.ode"
  Features features = 0;
  bool fixed_base = false;
  ModelFacts::Names held, freed;  ///< joints that nothing commands and the scenario leaves open; `freed`: with stops
};

/// What a model lacks for one motion. `names`: how many are named of each list.
std::vector<Finding> findings_of(const ModelFacts& facts, const CheckedMotion& motion, std::size_t names);

enum class Length {
  screen,  ///< about forty lines: the first few of what is alike
  full,
};

/// Templates whose robots lack the same, in the order of the scenario, with their findings, and a line for all that
/// lack nothing. Robots without a motion are left out.
std::vector<std::string> check_lines(const BuiltScenario& built, Length length);

/// "`a`, `b`, `c` and 4 more".
std::string first_of(const std::vector<std::string>& names, std::size_t most);

}  // namespace muro::host
