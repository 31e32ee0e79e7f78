// SPDX-License-Identifier: MIT
#include "solid.hpp"

#include <Eigen/Eigenvalues>
#include <numbers>

namespace muro::model_file {

namespace {

using std::numbers::pi;

/// A shape of density 1 about its own centre, in its own axes; mass 0 when it has no known volume.
Inertia solid(const Shape& shape) {
  const Vec3& s = shape.size;
  const auto ball_like = [](double mass, double xx, double yy, double zz) {
    return Inertia{.mass = mass, .ixx = mass * xx, .iyy = mass * yy, .izz = mass * zz};
  };
  const double r2 = s.x() * s.x();
  switch (shape.kind) {
    case ShapeKind::box: {
      const Vec3 d2 = s.cwiseAbs2() / 12;
      return ball_like(s.prod(), d2.y() + d2.z(), d2.x() + d2.z(), d2.x() + d2.y());
    }
    case ShapeKind::sphere:
      return ball_like(4.0 / 3 * pi * r2 * s.x(), 0.4 * r2, 0.4 * r2, 0.4 * r2);
    case ShapeKind::cylinder: {
      const double across = r2 / 4 + s.z() * s.z() / 12;
      return ball_like(pi * r2 * s.z(), across, across, r2 / 2);
    }
    case ShapeKind::capsule: {
      const double tube = pi * r2 * s.z(), balls = 4.0 / 3 * pi * r2 * s.x(), l = s.z(), r = s.x();
      const double across = tube * (r2 / 4 + l * l / 12) + balls * (0.4 * r2 + l * l / 4 + 0.375 * l * r);
      return {.mass = tube + balls, .ixx = across, .iyy = across, .izz = tube * r2 / 2 + balls * 0.4 * r2};
    }
    default:
      return {};
  }
}

}  // namespace

Inertia even_solid(std::span<const Shape> shapes, double mass) {
  Inertia whole;
  for (const Shape& shape : shapes) whole = whole + solid(shape).in(shape.origin);
  if (whole.mass > 0) return Inertia::from(mass, whole.com, whole.tensor() * (mass / whole.mass));
  constexpr double water = 1000;  // kg/m^3
  const double radius = std::cbrt(3 * mass / (4 * pi * water));
  return Inertia::from(mass, Vec3::Zero(), 0.4 * mass * radius * radius * Mat3::Identity());
}

TensorCheck check_tensor(const Mat3& tensor) {
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  TensorFault fault = TensorFault::none;
  // as written so that what is not a number is a fault
  if (!(moments[0] > 1e-9 * moments[2]))
    fault = TensorFault::not_positive;
  else if (moments[0] + moments[1] < 0.999 * moments[2])
    fault = TensorFault::no_body;
  return {moments, fault};
}

}  // namespace muro::model_file
