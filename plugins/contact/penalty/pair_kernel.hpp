// SPDX-License-Identifier: MIT
// Kernel: contacts of robots that touch something that moves, eight contacts at a time.
#pragma once

#include "contact_law.hpp"
#include "muro/simd/isa.hpp"

namespace muro::penalty {

/// One contact. Addresses are those of numbers: of the contact its point, normal, depth and friction; of a pose its
/// position, of a twist its linear and angular part.
struct PairPoint {
  const double* contact = nullptr;
  const double *pose = nullptr, *twist = nullptr;              ///< of the own body
  const double *other_pose = nullptr, *other_twist = nullptr;  ///< of the other
  const double* patch = nullptr;  ///< effective mass of its points along and across the normal, the inverse of the
                                  ///< latter, and the load of the bodies
  double lag = 0, other_lag = 0;  ///< see keys::twist_lag
  double turn[3] = {};  ///< m: slip of the middle of its cell against its own, for 1 rad/s (see pressure_cells.hpp)
  // what `move` writes
  double velocity[3];  ///< m/s, of the own point over the other
  double approach;     ///< m/s
  double ahead;        ///< m: what is to be added to the depth, where poses are ahead of twists
  double spin;         ///< rad/s: of the own body over the other about the normal
  // what `push` reads; it writes the displacement and the force
  double displacement[3];  ///< m: what the friction spring of the step before has; out: that of this step
  double overlap;          ///< m: what of the depth the spring does not see
  double zeta;             ///< damping ratio of the normal
  double force[3];         ///< N, on the own body
  double moment;           ///< N m, on the same about the normal: friction acts in the middle of the cell
};

struct PairKernels {
  /// Velocities. `with_lag`: any contact has a lag. Each contact gets the same bits as by itself.
  void (*move)(PairPoint* points, int count, double h, bool with_lag);
  /// Forces; `elapsed`: s since the last run. Each contact gets the same bits as by itself.
  void (*push)(PairPoint* points, int count, const Stiffness& stiffness, double elapsed);
};
MURO_DECLARE_KERNELS(PairKernels, pair_kernels)

}  // namespace muro::penalty
