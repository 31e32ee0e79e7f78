// SPDX-License-Identifier: MIT
#include "inertia.hpp"
#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"
#include "muro/base/limits.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

namespace muro::model_file {

namespace {

using std::numbers::pi;

/// Returns the inertia of a shape of density 1 about its own centre, in its own axes; mass 0 if it has no known volume.
Inertia unit_density_inertia(const Shape& shape) {
  const Vec3& s = shape.size;
  const auto symmetric = [](double mass, double xx, double yy, double zz) {
    return Inertia{.mass = mass, .ixx = mass * xx, .iyy = mass * yy, .izz = mass * zz};
  };
  const double r2 = s.x() * s.x();
  switch (shape.kind) {
    case ShapeKind::box: {
      const Vec3 d2 = s.cwiseAbs2() / 12;
      return symmetric(s.prod(), d2.y() + d2.z(), d2.x() + d2.z(), d2.x() + d2.y());
    }
    case ShapeKind::sphere:
      return symmetric(4.0 / 3 * pi * r2 * s.x(), 0.4 * r2, 0.4 * r2, 0.4 * r2);
    case ShapeKind::cylinder: {
      const double across = r2 / 4 + s.z() * s.z() / 12;
      return symmetric(pi * r2 * s.z(), across, across, r2 / 2);
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

std::string text_of(const Vec3& v) { return concat(v.x(), " ", v.y(), " ", v.z()); }

bool has_known_volume(const Shape& shape) { return half_extents(shape).allFinite() && shape.kind != ShapeKind::mesh; }

}  // namespace

Inertia uniform_density_inertia(std::span<const Shape> shapes, double mass) {
  Inertia sum;
  for (const Shape& shape : shapes) sum = sum + unit_density_inertia(shape).in(shape.origin);
  if (sum.mass > 0) return Inertia::from(mass, sum.com, sum.tensor() * (mass / sum.mass));
  constexpr double water = 1000;  // kg/m^3
  const double radius = elementary::cbrt(3 * mass / (4 * pi * water));
  return Inertia::from(mass, Vec3::Zero(), 0.4 * mass * radius * radius * Mat3::Identity());
}

TensorCheck check_tensor(const Mat3& tensor) {
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  TensorError error = TensorError::none;
  // in this form, a value that is not a number is an error
  if (!(moments[0] > 1e-9 * moments[2]))
    error = TensorError::not_positive_definite;
  else if (moments[0] + moments[1] < 0.999 * moments[2])
    error = TensorError::violates_triangle_inequality;
  return {moments, error};
}

Inertia checked_inertia(const Inertia& given, const Pose& frame, std::span<const Shape> shapes,
                        const std::string& owner, const FileLocation& location, Problems& problems) {
  if (given.mass < 0) {
    problems.warning(location, concat(owner, ": the mass is ", given.mass,
                                      " kg and taken as 0, a frame without a body; it is 0 or more"));
    return {};
  }
  if (given.mass == 0) {
    problems.note(location, owner + " has the mass 0: it is a frame without a body");
    return {};
  }
  if (given.mass < limits::min_mass) {
    problems.warning(location, concat(owner, ": the mass is ", given.mass, " kg and taken as 0, a frame without a ",
                                      "body; the least is ", limits::min_mass, " kg"));
    return {};
  }
  const Inertia inertia = given.in(frame);
  const auto [moments, error] = check_tensor(given.tensor());
  if (!inertia.com.allFinite() || !inertia.tensor().allFinite() || !moments.allFinite()) {
    problems.error(location, owner + ": its inertia is too large for a number; use kg, m and kg m^2");
    return {};
  }
  if (error == TensorError::violates_triangle_inequality)
    problems.warning(location, concat(owner, ": its principal moments of inertia are ", text_of(moments),
                                      " kg m^2, which no body has: none exceeds the sum of the other two. They are ",
                                      "used as they are"));
  if (error != TensorError::not_positive_definite) return inertia;
  Inertia uniform = uniform_density_inertia(shapes, given.mass);
  const bool from_shapes = std::any_of(shapes.begin(), shapes.end(), has_known_volume) && uniform.tensor().allFinite();
  if (!from_shapes) uniform = uniform_density_inertia({}, given.mass);
  const std::string used = from_shapes ? "its shapes with uniform density and " : "a ball of water of ";
  problems.warning(location, concat(owner, ": its principal moments of inertia are ", text_of(moments),
                                    " kg m^2, and the least must be above 1e-9 times the greatest; those of ", used,
                                    given.mass, " kg are used: ", text_of({uniform.ixx, uniform.iyy, uniform.izz})));
  return Inertia::from(given.mass, inertia.com, uniform.tensor());
}

}  // namespace muro::model_file
