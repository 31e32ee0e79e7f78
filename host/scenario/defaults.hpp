// SPDX-License-Identifier: MIT
// The algorithms that are added when a scenario does not name one.
#pragma once

namespace muro::host {

/// A scene-wide algorithm that is used when something reads `property` and nothing in the scenario writes it.
struct DefaultAlgorithm {
  const char* property;
  const char* name;
  const char* use;
};
inline constexpr DefaultAlgorithm default_algorithms[] = {
    {"wrench.external", "contact", "contact.penalty"},
    {"contacts", "collision", "collision.native"},
    {"scene.index", "index", "scene.bvh"},
};

}  // namespace muro::host
