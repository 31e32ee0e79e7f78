// SPDX-License-Identifier: MIT
// Features that robots use and that the motions which a scenario gives them do not support.
#pragma once

#include <string>
#include <vector>

#include "host/scenario/builder.hpp"
#include "muro/features.hpp"

namespace muro::host {

/// A feature that a robot uses and its motion does not support.
struct UnsupportedFeature {
  Features bit;        ///< one of Feature
  std::string amount;  ///< "4 joints", or empty
  bool implied;        ///< by another one: where no force moves a robot, contacts do not stop it either
};

/// What one motion does not support of what robots of one template use.
struct UnsupportedFeatures {
  std::string robots;  ///< name of the template
  std::string motion;  ///< "motion.point"
  Location location;   ///< of the motion in the scenario
  std::vector<UnsupportedFeature> all;
};

/// One for each template and motion that has unsupported features, in the order of the scenario. A motion whose plugin
/// does not declare its features is left out.
std::vector<UnsupportedFeatures> find_unsupported_features(const BuiltScenario& built);

/// brief: "moving links do not push back on the base (3 joints)". full: the names of the features that
/// these imply follow.
enum class Detail { brief, full };
std::string text_of(const UnsupportedFeatures& unsupported, Detail detail);

/// Prints a line for each, and for each robot whose joints cannot start at 0, to standard error; `strict`: throws the
/// lines as a SetupError, with what readers have said of collision shapes whose files are not there.
void report_unsupported(const BuiltScenario& built, Detail detail, bool strict);

}  // namespace muro::host
