// SPDX-License-Identifier: MIT
// Overlap that no motion has made: bodies that start, or are put, inside other bodies.
#pragma once

#include <algorithm>

#include "bodies.hpp"

namespace muro::penalty {

/// Smallest overlap of this kind, m. For new contacts that are less deep, the overlap counts as 0.
inline constexpr double least_overlap = 5e-3;

/// Returns the part of the depth of a contact that its spring does not see (m). A spring of the whole depth would throw
/// bodies out of each other. So overlap that was there before they moved is taken back at `correcting_speed`. `before`:
/// of the nearest friction anchor of the pair in the step before; null: none. `approach`: speed of the bodies towards
/// each other (m/s).
inline double unmoved_overlap(const StepContext& context, const Contact& contact, const AnchorDetail* before,
                              double approach) {
  if (before) return std::clamp(before->overlap - context.correcting_speed * context.elapsed, 0.0, contact.depth);
  const double moved = 2 * std::max(approach, 0.0) * context.elapsed;
  return contact.depth > least_overlap + moved ? contact.depth : 0;
}

}  // namespace muro::penalty
