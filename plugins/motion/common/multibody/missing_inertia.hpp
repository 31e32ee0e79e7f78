// SPDX-License-Identifier: MIT
// Inertias that are large enough for contacts.
#pragma once

#include <Eigen/Eigenvalues>
#include <optional>

#include "muro/scene.hpp"

namespace muro {

/// Returns the tensor to add to `inertia` (kg m^2, about the centre of mass) so that it is at least a hundredth of the
/// inertia of a box of uniform density, about every axis. Returns nothing when it is that large already: a hundredth is
/// possible when all mass lies within a tenth of the size. Model files hold inertias of 1e-9 or 1e-6 kg m^2 that nobody
/// has measured. Then a contact at a corner has hardly any effective mass: it only turns the body and cannot hold it.
/// [setup]
inline std::optional<Mat3> missing_inertia(const Inertia& inertia, const Aabb& box) {
  constexpr double least = 0.01;
  const Vec3 size = box.high - box.low, squares = size.cwiseProduct(size);
  const Vec3 floor =
      least * inertia.mass / 12 * Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  // scaled so that the least inertia is 1 about every axis
  const Vec3 root = floor.cwiseSqrt();
  const Mat3 scaled = root.cwiseInverse().asDiagonal() * inertia.tensor() * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(scaled);
  if (!principal.eigenvalues().allFinite() || principal.eigenvalues().minCoeff() >= 1) return {};
  const Vec3 missing = (Vec3::Ones() - principal.eigenvalues()).cwiseMax(0);
  const Mat3& axes = principal.eigenvectors();
  return Mat3(root.asDiagonal() * (axes * missing.asDiagonal() * axes.transpose()) * root.asDiagonal());
}

}  // namespace muro
