// SPDX-License-Identifier: MIT
// Features that robots use and that their motions in the scenario do not support.
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
  bool implied;        ///< by another one: if no force moves a robot, contacts do not stop it either
};

/// Features that robots of one template use and one motion does not support.
struct UnsupportedFeatures {
  std::string robots;  ///< name of the template
  std::string motion;  ///< "motion.point"
  Location location;   ///< of the motion in the scenario
  std::vector<UnsupportedFeature> all;
};

/// Returns an entry for each template and motion with unsupported features, in the order of the scenario. A motion is
/// left out when its plugin does not declare its features.
std::vector<UnsupportedFeatures> find_unsupported_features(const BuiltScenario& built);

/// brief: "moving links do not push back on the base (3 joints)". full: also the names of the features that these
/// imply.
enum class Detail { brief, full };
std::string text_of(const UnsupportedFeatures& unsupported, Detail detail);

/// Prints a line for each, and for each robot with joints that cannot start at 0, to standard error. `strict`: throws
/// these lines as a SetupError, with the messages of readers about collision shapes with missing files.
void report_unsupported(const BuiltScenario& built, Detail detail, bool strict);

}  // namespace muro::host
