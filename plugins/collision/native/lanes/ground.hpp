// SPDX-License-Identifier: MIT
// Kernels: robots of identical structure against the planes of the scenery.
#pragma once

#include "muro/simd/isa.hpp"
#include "solid.hpp"

namespace muro::native {

/// A slot is a solid and a plane, in the order of body, plane, solid. Six slots share one word of a signature, so that
/// the bits of its points (eight a slot) are exact in a double.
inline constexpr int slots_of_word = 6;
/// A contact's numbers: point, normal, depth; of which the kernel writes the point (0 to 2) and the depth.
inline constexpr int depth_number = 6;

/// What one call works on: at most eight robots.
struct GroundWork {
  const Solid* solids = nullptr;  ///< of each robot, body by body
  int solid_count = 0;
  const Ground* planes = nullptr;
  int plane_count = 0;
  int contact_stride = 0;  ///< in numbers
  int used = 0;            ///< robots
  Poses poses[8];
  double* contacts[8];    ///< of each robot: the numbers of its first contact
  double* signatures[8];  ///< of each robot, the words of which points touch: as known before, then as they are now
};

/// How many words a signature has; the last may be empty.
constexpr int words_of(int solids, int planes) { return solids * planes / slots_of_word + 1; }

/// Writes contacts ordered by body, plane, solid and number of the point, and the signatures. A robot needs room for
/// eight contacts a slot. Returns a bit for each robot whose signature has changed.
struct GroundKernels {
  unsigned (*touch)(const GroundWork&);
};
MURO_DECLARE_KERNELS(GroundKernels, ground_kernels)

}  // namespace muro::native
