// SPDX-License-Identifier: MIT
#include "rolling_constraints.hpp"

#include <Eigen/Eigenvalues>

namespace muro::wheels {

namespace {

/// Returns the adjugate of a symmetric matrix.
Mat3 adjugate(const Mat3& m) {
  const double a = m(0, 0), b = m(1, 1), c = m(2, 2), d = m(0, 1), e = m(0, 2), f = m(1, 2);
  Mat3 adjugate;
  adjugate << b * c - f * f, e * f - d * c, d * f - b * e, e * f - d * c, a * c - e * e, d * e - a * f, d * f - b * e,
      d * e - a * f, a * b - d * d;
  return adjugate;
}

}  // namespace

RollingConstraints::NullSpace RollingConstraints::null_space_of(const Mat3& normal) {
  const double size = normal.trace();
  const Mat3 first = adjugate(normal);
  const double minors = first.trace();
  if (minors > 1e-6 * size * size) {
    int column = 0;
    first.diagonal().maxCoeff(&column);
    Vec3 v = first.col(column).normalized();
    for (int iteration = 0; iteration < 4; ++iteration) {
      const Vec3 image = normal * v;
      const double value = v.dot(image), others = size - value;
      if ((image - value * v).squaredNorm() < 1e-30 * size * size) {
        const bool is_smallest = others > 2 * value && minors - 2 * value * others + value * value > 0;
        if (is_smallest) return {v};
        break;
      }
      v = (adjugate(normal - value * Mat3::Identity()) * v).normalized();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> all(normal);  // smallest first
  if (all.eigenvalues()[1] > 1e-12 * size) return {all.eigenvectors().col(0)};
  return {all.eigenvectors().col(0), all.eigenvectors().col(1)};
}

}  // namespace muro::wheels
