// SPDX-License-Identifier: MIT
// What holds where a scenario says nothing.
#pragma once

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

}  // namespace muro::host
