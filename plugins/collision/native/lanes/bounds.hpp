// SPDX-License-Identifier: MIT
// Kernels: the boxes around robots of identical structure.
#pragma once

#include "muro/simd/isa.hpp"
#include "solid.hpp"

namespace muro::native {

/// What part of a robot stays in: the points that are within `ball` of a box in a body, along the body's axes.
struct Part {
  Spot pose;              ///< of the body
  double centre[3] = {};  ///< m
  double half[3] = {};    ///< m
  double ball = 0;        ///< m

  friend bool operator==(const Part&, const Part&) = default;
};

/// What one call works on: at most eight robots.
struct BoundsWork {
  const Part* parts = nullptr;  ///< of each robot, one a body; at least one
  int part_count = 0;
  int used = 0;  ///< robots
  Poses poses[8];
  double* boxes[8];  ///< of each robot: low and high of `bounds`, which is written, then of `room`
};

struct BoundsKernels {
  /// Returns a bit for each robot that is not within its room.
  unsigned (*bound)(const BoundsWork&);
};
MURO_DECLARE_KERNELS(BoundsKernels, bounds_kernels)

}  // namespace muro::native
