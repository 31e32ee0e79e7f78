// SPDX-License-Identifier: MIT
// Physically consistent inertias: inertias that a real body can have (Wensing, Kim and Slotine, 2018). No principal
// moment exceeds the sum of the other two.
#pragma once

#include <Eigen/Eigenvalues>
#include <optional>

#include "muro/geometry.hpp"

namespace muro {

/// Returns `inertia` with both smaller moments raised by the same amount until their sum is the largest: the nearest
/// flat body. Returns nothing when the inertia is not finite, or is consistent up to a thousandth of the largest moment
/// (the rounding in files). Model files hold moments that no real body has. With Euler's equations the spin of such a
/// body grows without end: (I_a - I_b) / I_c is at most 1 for a real body, but unbounded here, and no step is short
/// enough. [setup]
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
