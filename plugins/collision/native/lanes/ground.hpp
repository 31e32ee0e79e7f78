// SPDX-License-Identifier: MIT
// Kernels: robots of identical structure against the planes of the scenery.
#pragma once

#include "kernel_shape.hpp"
#include "muro/simd/isa.hpp"

namespace muro::native {

/// A slot is a shape and a plane, in the order of body, plane, shape. Six slots share one word of a signature, so that
/// the bits of its points (eight a slot) are exact in a double.
inline constexpr int slots_per_word = 6;
/// A contact's numbers: point, normal, depth; of which the kernel writes the point (0 to 2) and the depth.
inline constexpr int depth_number = 6;

/// The input and output of one call: at most eight robots.
struct GroundBatch {
  const KernelShape* shapes = nullptr;  ///< of each robot, body by body
  int shape_count = 0;
  const GroundPlane* planes = nullptr;
  int plane_count = 0;
  int contact_stride = 0;  ///< in numbers
  int used = 0;            ///< robots
  RobotPoses poses[8];
  double* contacts[8];    ///< of each robot: the numbers of its first contact
  double* signatures[8];  ///< of each robot, a bit a point that touches: of the step before, then of this one
};

/// How many words a signature has; the last may be empty.
constexpr int words_of(int shapes, int planes) { return shapes * planes / slots_per_word + 1; }

/// Writes contacts ordered by body, plane, shape and number of the point, and the signatures. The list of a robot needs
/// capacity for eight contacts a slot. Returns a bit for each robot whose signature has changed.
struct GroundKernels {
  unsigned (*find_contacts)(const GroundBatch&);
};
MURO_DECLARE_KERNELS(GroundKernels, ground_kernels)

}  // namespace muro::native
