// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>

#include "muro/shape.hpp"

namespace muro::test {

/// Returns a shape of this kind with sizes from `random.length()` (m).
template <class Random>
Shape shape_of(ShapeKind kind, Random& random) {
  switch (kind) {
    case ShapeKind::box:
      return Shape::box({random.length(), random.length(), random.length()});
    case ShapeKind::sphere:
      return Shape::sphere(0.5 * random.length());
    case ShapeKind::cylinder:
      return Shape::cylinder(0.5 * random.length(), random.length());
    case ShapeKind::capsule:
      return Shape::capsule(0.5 * random.length(), random.length());
    default:
      return Shape::plane();
  }
}

/// Random numbers, rotations and shapes; equal for equal seeds.
class Randoms {
 public:
  explicit Randoms(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  Vec3 direction() {
    std::normal_distribution<double> g;
    for (;;) {
      const Vec3 v(g(engine_), g(engine_), g(engine_));
      if (v.norm() > 1e-3) return v.normalized();
    }
  }
  Quat rotation() {
    std::normal_distribution<double> g;
    return Quat(Eigen::Quaterniond(g(engine_), g(engine_), g(engine_), g(engine_)).normalized());
  }
  /// Returns one of the 24 rotations that map the axes on each other.
  Quat right_angles() {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    for (const int axis : {0, 1, 2, 0}) q = q * Eigen::AngleAxisd(below(4) * M_PI / 2, Vec3::Unit(axis));
    Mat3 m = q.toRotationMatrix().unaryExpr([](double x) { return std::round(x); });
    return Quat(m);
  }
  /// Returns 0.05 to 2 m, all orders of magnitude with equal probability.
  double length() { return 0.05 * std::pow(40.0, uniform(0, 1)); }
  Shape shape(ShapeKind kind) { return shape_of(kind, *this); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace muro::test
