// SPDX-License-Identifier: MIT
// Tensors that some body has: of its principal moments, none exceeds the sum of the other two.
#pragma once

#include <Eigen/Eigenvalues>
#include <optional>

#include "muro/geometry.hpp"

namespace muro {

/// Files hold moments that no body has. In Euler's equations such a body turns itself faster and faster: its
/// (I_a - I_b) / I_c, at most 1 for every body, has no bound, and no step is short enough. This is `inertia` with both
/// smaller moments raised by the same, to a sum that is the largest: the nearest flat body. None where no moment
/// exceeds the sum of the others by more than a thousandth of itself (what rounding in files does), or where they are
/// not finite. [setup]
inline std::optional<Inertia> made_physical(const Inertia& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia.tensor());
  Vec3 moments = principal.eigenvalues();  // in increasing order
  if (!moments.allFinite()) return {};
  const double lack = moments[2] - moments[0] - moments[1];
  if (!(lack > 1e-3 * moments[2])) return {};
  moments[0] += 0.5 * lack;
  moments[1] += 0.5 * lack;
  const Mat3& axes = principal.eigenvectors();
  return Inertia::from(inertia.mass, inertia.com, axes * moments.asDiagonal() * axes.transpose());
}

}  // namespace muro
