// SPDX-License-Identifier: MIT
// Normal equations of a least-squares problem with three unknowns.
#pragma once

#include <array>
#include <cstddef>

namespace soccer {

using Vector3 = std::array<double, 3>;

/// A symmetric matrix of 3 x 3.
struct Symmetric3 {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  Vector3 operator*(const Vector3& v) const {
    return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2], xz * v[0] + yz * v[1] + zz * v[2]};
  }
  /// Returns v' M v.
  double square(const Vector3& v) const {
    const Vector3 w = *this * v;
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
  }
  /// Returns the inverse of a positive definite matrix.
  Symmetric3 inverse() const {
    const Symmetric3 c{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                       xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz};
    const double determinant = xx * c.xx + xy * c.xy + xz * c.xz;
    const double s = 1 / determinant;
    return {s * c.xx, s * c.yy, s * c.zz, s * c.xy, s * c.xz, s * c.yz};
  }
};

/// Finds the unknowns d that minimise the sum of weight (residual - gradient d)^2.
class LeastSquares {
 public:
  /// `information`, `difference`: prior knowledge; the sum begins with (difference - d)' information (difference - d).
  LeastSquares(const Symmetric3& information, const Vector3& difference)
      : matrix_(information), vector_(information * difference) {}

  void add(const Vector3& gradient, double residual, double weight) {
    const auto& g = gradient;
    matrix_.xx += weight * g[0] * g[0], matrix_.yy += weight * g[1] * g[1], matrix_.zz += weight * g[2] * g[2];
    matrix_.xy += weight * g[0] * g[1], matrix_.xz += weight * g[0] * g[2], matrix_.yz += weight * g[1] * g[2];
    for (std::size_t i = 0; i < 3; ++i) vector_[i] += weight * g[i] * residual;
  }
  Symmetric3 covariance() const { return matrix_.inverse(); }
  Vector3 solution() const { return covariance() * vector_; }

 private:
  Symmetric3 matrix_;
  Vector3 vector_;
};

}  // namespace soccer
