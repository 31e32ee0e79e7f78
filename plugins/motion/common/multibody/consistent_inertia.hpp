// SPDX-License-Identifier: MIT
// Physically consistent inertias: those that some body has (Wensing, Kim and Slotine, 2018). Of its principal moments,
// none exceeds the sum of the other two.
#pragma once

#include <Eigen/Eigenvalues>
#include <optional>

#include "muro/geometry.hpp"

namespace muro {

/// Model files hold moments that no body has. In Euler's equations the spin of such a body grows without end: its
/// (I_a - I_b) / I_c, at most 1 for every body, has no bound, and no step is short enough. This is `inertia` with both
/// smaller moments raised by the same amount, until their sum is the largest: the nearest flat body. None where the
/// inertia is consistent, up to a thousandth of the largest moment (the rounding in files), or not finite. [setup]
inline std::optional<Inertia> nearest_consistent_inertia(const Inertia& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia.tensor());
  Vec3 moments = principal.eigenvalues();  // in increasing order
  if (!moments.allFinite()) return {};
  const double excess = moments[2] - moments[0] - moments[1];
  if (!(excess > 1e-3 * moments[2])) return {};
  moments[0] += 0.5 * excess;
  moments[1] += 0.5 * excess;
  const Mat3& axes = principal.eigenvectors();
  return Inertia::from(inertia.mass, inertia.com, axes * moments.asDiagonal() * axes.transpose());
}

}  // namespace muro
