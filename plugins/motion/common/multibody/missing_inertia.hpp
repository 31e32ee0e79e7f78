// SPDX-License-Identifier: MIT
// Inertias that contacts can hold.
#pragma once

#include <Eigen/Eigenvalues>
#include <optional>

#include "muro/scene.hpp"

namespace muro {

/// Model files hold inertias of 1e-9 or 1e-6 kg m^2 that nobody has measured. A contact at a corner has hardly any
/// effective mass then, for the body only turns away under it, and what holds the corner cannot hold the body. This is
/// what has to be added to `inertia` (kg m^2, about the centre of mass) so that about no axis it is less than a
/// hundredth of that of a box of uniform density. None where it is not less: a body whose mass lies within a tenth of
/// its size is possible. [setup]
inline std::optional<Mat3> missing_inertia(const Inertia& inertia, const Aabb& box) {
  constexpr double least = 0.01;
  const Vec3 size = box.high - box.low, squares = size.cwiseProduct(size);
  const Vec3 floor =
      least * inertia.mass / 12 * Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  // in units in which the least inertia is 1 about every axis
  const Vec3 root = floor.cwiseSqrt();
  const Mat3 scaled = root.cwiseInverse().asDiagonal() * inertia.tensor() * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(scaled);
  if (!principal.eigenvalues().allFinite() || principal.eigenvalues().minCoeff() >= 1) return {};
  const Vec3 missing = (Vec3::Ones() - principal.eigenvalues()).cwiseMax(0);
  const Mat3& axes = principal.eigenvectors();
  return Mat3(root.asDiagonal() * (axes * missing.asDiagonal() * axes.transpose()) * root.asDiagonal());
}

}  // namespace muro
