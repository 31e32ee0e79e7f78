// SPDX-License-Identifier: MIT
// Helpers of the tests of the shape pairs: random shapes, and a check of a result that uses nothing of the code under
// test but the shapes.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "pairs/collide.hpp"
#include "tests/support/randoms.hpp"

namespace muro::native::testing {

/// Returns the farthest extent (m) of the shape along the unit vector n, from the world's origin.
inline double extent(const TransformedShape& s, const Vec3& n) {
  const Vec3 c = s.axes.transpose() * n;
  double reach = s.radius();
  if (s.kind == ShapeKind::box) reach = s.half.dot(c.cwiseAbs());
  if (s.kind == ShapeKind::cylinder) reach = s.radius() * std::hypot(c.x(), c.y()) + s.half.z() * std::abs(c.z());
  if (s.kind == ShapeKind::capsule) reach = s.radius() + s.half.z() * std::abs(c.z());
  return s.centre.dot(n) + reach;
}

/// Returns the distance (m) that `a` must move along n to be clear of `b`.
inline double depth_along(const TransformedShape& a, const TransformedShape& b, const Vec3& n) {
  return extent(b, n) + extent(a, -n);
}

inline double size_of(const TransformedShape& s) {
  return s.kind == ShapeKind::box ? s.half.norm() : s.radius() + s.half.z();
}

using test::Randoms;

/// Directions spread evenly over the sphere (Fibonacci lattice).
inline const std::vector<Vec3>& directions(int count) {
  static std::vector<Vec3> all;
  if (int(all.size()) == count) return all;
  all.clear();
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, angle = i * M_PI * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    all.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return all;
}

/// Returns the least depth over many directions; a local search improves the best few. It is never below the true least
/// depth, and hardly above it.
inline double sampled_depth(const TransformedShape& a, const TransformedShape& b, int count = 600, int starts = 6) {
  std::vector<std::pair<double, Vec3>> tried;
  for (const Vec3& n : directions(count)) tried.push_back({depth_along(a, b, n), n});
  std::partial_sort(tried.begin(), tried.begin() + starts, tried.end(),
                    [](const auto& p, const auto& q) { return p.first < q.first; });
  double least = tried[0].first;
  for (int s = 0; s < starts; ++s) {
    auto [value, n] = tried[s];
    Mat3 axes = a.axes;
    for (double step = 0.1; step > 1e-9; step *= 0.5)
      for (int moves = 0, lower = true; lower && moves < 20; ++moves) {
        lower = false;
        axes.col(0) = n.unitOrthogonal();
        axes.col(1) = n.cross(axes.col(0));
        for (int k = 0; k < 16; ++k) {
          const double angle = k * M_PI / 8;
          const Vec3 next = (n + step * (std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1))).normalized();
          const double then = depth_along(a, b, next);
          if (then >= value - 1e-15) continue;
          value = then, n = next;
          lower = true;
        }
      }
    least = std::min(least, value);
  }
  return least;
}

inline const ContactPoint* deepest(const Manifold& m) {
  const ContactPoint* best = nullptr;
  for (int i = 0; i < m.count; ++i)
    if (!best || m.points[i].depth > best->depth) best = &m.points[i];
  return best;
}

/// Returns how far (m) the point lies outside the shape; 0 inside.
inline double outside(const TransformedShape& s, const Vec3& point) {
  const Vec3 p = s.axes.transpose() * (point - s.centre);
  if (s.kind == ShapeKind::sphere) return std::max(0.0, p.norm() - s.radius());
  if (s.kind == ShapeKind::plane) return std::max(0.0, p.z());
  if (s.kind == ShapeKind::box) return (p - p.cwiseMin(s.half).cwiseMax(-s.half)).norm();
  const double over = std::max(0.0, std::abs(p.z()) - s.half.z()), off = std::hypot(p.x(), p.y());
  if (s.kind == ShapeKind::capsule) return std::max(0.0, std::hypot(off, over) - s.radius());
  return std::hypot(over, std::max(0.0, off - s.radius()));
}

}  // namespace muro::native::testing
