// SPDX-License-Identifier: MIT
// What robots go without because of the motions that a scenario gives them.
#pragma once

#include <string>
#include <vector>

#include "host/scenario/builder.hpp"
#include "muro/features.hpp"

namespace muro::host {

/// A feature that a robot would use and its motion does not have.
struct Loss {
  Features bit;        ///< one of Feature
  std::string amount;  ///< "4 joints", or empty
  bool follows;        ///< from another loss: where no force moves a robot, nothing stops it either
};

/// What robots of one template lose by one motion.
struct Losses {
  std::string robots;  ///< name of the template
  std::string motion;  ///< "motion.point"
  Location location;   ///< of the motion in the scenario
  std::vector<Loss> all;
};

/// One for each template and motion by which something is lost, in the order of the scenario. A motion whose plugin
/// does not say what it can do is left out.
std::vector<Losses> losses_of(const BuiltScenario& built);

/// "forces and contacts do not move it; its joints do not move (4 joints)". Fully: and the names of what goes with
/// that.
enum class Length { shortly, fully };
std::string text_of(const Losses& losses, Length length);

/// Prints a line each to standard error; `strict`: throws them as a SetupError.
void tell(const std::vector<Losses>& losses, Length length, bool strict);

}  // namespace muro::host
