// SPDX-License-Identifier: MIT
// What holds where a scenario says nothing.
#pragma once

#include <optional>

#include "muro/description.hpp"

namespace muro::host {

/// A scene-wide algorithm that is used when something reads `property` and nothing in the scenario writes it.
struct Default {
  const char* property;
  const char* name;
  const char* use;
};
inline constexpr Default defaults[] = {
    {"wrench.external", "contact", "contact.penalty"},
    {"contacts", "collision", "collision.native"},
    {"scene.index", "index", "scene.bvh"},
};

/// Whether somebody else reads what algorithms of this kind write, so that they can run when asked.
inline bool may_run_on_demand(Kind kind) {
  switch (kind) {
    case Kind::kinematics:
    case Kind::scene:
    case Kind::collision:
    case Kind::contact:
    case Kind::drive:
    case Kind::sensor:
    case Kind::sensor_error:
      return true;
    default:
      return false;
  }
}

/// What a rate is when the scenario names none; 0: on demand.
inline std::optional<double> default_rate(Kind kind) {
  if (kind == Kind::motion) return 1000;
  if (kind == Kind::sensor || !may_run_on_demand(kind)) return std::nullopt;
  return 0;
}

}  // namespace muro::host
