// SPDX-License-Identifier: MIT
#include "free_rotation.hpp"

#include <array>
#include <cmath>

namespace muro::multibody {

namespace {

constexpr int order = 20;
constexpr double longest_turn = 0.1;  ///< rad, in one series
constexpr int most_parts = 10000;     ///< 1000 rad a step: no real body turns that fast

using Quaternion = Eigen::Vector4d;  ///< x, y, z, w

/// q times the pure quaternion v.
Quaternion times(const Quaternion& q, const Vec3& v) {
  const Vec3 u = q.head<3>();
  const Vec3 vector = q.w() * v + u.cross(v);
  return {vector.x(), vector.y(), vector.z(), -u.dot(v)};
}

/// Advances by a turn that is short enough for the series. `momentum`: in axes of the body.
void advance_part(Quaternion& q, Vec3& momentum, const Mat3& inverse, double h) {
  std::array<Vec3, order + 1> l, w;
  std::array<Quaternion, order + 1> p;
  l[0] = momentum;
  p[0] = q;
  double power = 1;
  for (std::size_t k = 0; k < order; ++k) {
    w[k] = inverse * l[k];
    Vec3 momentum_rate = Vec3::Zero();
    Quaternion turn_rate = Quaternion::Zero();
    for (std::size_t i = 0; i <= k; ++i) {
      momentum_rate += l[i].cross(w[k - i]);
      turn_rate += times(p[i], w[k - i]);
    }
    l[k + 1] = momentum_rate / double(k + 1);
    p[k + 1] = turn_rate / (2 * double(k + 1));
    power *= h;
    const Vec3 more_momentum = power * l[k + 1];
    const Quaternion more_turn = power * p[k + 1];
    momentum += more_momentum;
    q += more_turn;
    if (more_momentum.squaredNorm() <= 1e-36 * momentum.squaredNorm() && more_turn.squaredNorm() <= 1e-36) break;
  }
  q /= q.norm();
}

}  // namespace

void FreeRotation::advance(const Mat3& inertia, const Mat3& inverse, double dt) {
  const double turn = spin.norm() * dt;
  if (!(turn > 0) || !std::isfinite(turn)) return;
  Vec3 momentum = inertia * (orientation.conjugate() * spin);
  // The spin of a body that tumbles grows at most by the ratio of its moments.
  const double fastest = std::max(spin.norm(), (inverse * momentum.norm()).norm());
  const int parts = int(std::min(std::ceil(fastest * dt / longest_turn), double(most_parts)));
  Quaternion q = orientation.coeffs();
  for (int i = 0; i < parts; ++i) advance_part(q, momentum, inverse, dt / parts);
  orientation.coeffs() = q;
  spin = orientation * Vec3(inverse * momentum);
}

}  // namespace muro::multibody
