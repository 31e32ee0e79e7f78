// SPDX-License-Identifier: MIT
// Bodies that a further trial of a step folds: those that have changed, and those that they hang on. The rest that
// hangs on the base or on a fork is taken as it was.
#pragma once

#include <cstdint>

#include "structure.hpp"

namespace muro::articulated {

enum class Folding : std::uint8_t {
  whole,  ///< the body is folded
  kept,   ///< its parent gets the same inertia as before
  none,   ///< its parent is not folded either
};

/// Plans a trial. `changed`: per body, whether its joint or what acts on it has changed; `to`: out, one per body.
inline void plan_folding(const Structure& s, const bool* changed, Folding* to) {
  for (int k = 0; k < s.count; ++k) to[k] = changed[k] ? Folding::whole : Folding::none;
  for (int k = s.count; k-- > 1;)
    if (to[k] == Folding::whole) to[s.bodies[k].parent] = Folding::whole;
  to[0] = Folding::whole;
  for (int k = 1; k < s.count; ++k) {
    const Body& b = s.bodies[k];
    if (to[k] == Folding::none && to[b.parent] == Folding::whole) to[k] = b.kept ? Folding::kept : Folding::whole;
  }
}

}  // namespace muro::articulated
