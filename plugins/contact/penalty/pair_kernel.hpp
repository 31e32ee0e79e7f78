// SPDX-License-Identifier: MIT
// Kernel: contacts of robots that touch something that moves, eight contacts at a time.
#pragma once

#include "contact_law.hpp"
#include "muro/simd/isa.hpp"

namespace muro::penalty {

/// One contact. Addresses point to numbers: point, normal, depth and friction of the contact; position of a pose;
/// linear and angular part of a twist.
struct PairPoint {
  const double* contact = nullptr;
  const double *pose = nullptr, *twist = nullptr;              ///< of the own body
  const double *other_pose = nullptr, *other_twist = nullptr;  ///< of the other body
  const double* patch = nullptr;  ///< effective mass of its points along and across the normal, the inverse of the
                                  ///< latter, and the load of the bodies
  double lag = 0, other_lag = 0;  ///< see keys::twist_lag
  double turn[3] = {};  ///< m: slip of the middle of its cell relative to its own, for 1 rad/s (see pressure_cells.hpp)
  // written by `move`
  double velocity[3];  ///< m/s, of the own point over the other
  double approach;     ///< m/s
  double ahead;        ///< m: is added to the depth, if poses are ahead of twists
  double spin;         ///< rad/s: of the own body over the other about the normal
  // read by `push`, which writes the displacement, the force and the moment
  double displacement[3];  ///< m: of the friction spring in the step before; out: in this step
  double overlap;          ///< m: part of the depth that the spring does not see
  double zeta;             ///< damping ratio of the normal
  double force[3];         ///< N, on the own body
  double moment;           ///< N m, on the own body about the normal: friction acts in the middle of the cell
};

struct PairKernels {
  /// Computes velocities. `with_lag`: any contact has a lag. Each contact gets the same bits as alone.
  void (*move)(PairPoint* points, int count, double h, bool with_lag);
  /// Computes forces. `elapsed`: s since the last run. Each contact gets the same bits as alone.
  void (*push)(PairPoint* points, int count, const Stiffness& stiffness, double elapsed);
};
MURO_DECLARE_KERNELS(PairKernels, pair_kernels)

}  // namespace muro::penalty
