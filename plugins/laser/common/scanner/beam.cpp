// SPDX-License-Identifier: MIT
#include "beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"

namespace muro::scanner {

namespace {

/// The mean distance from the middle of the disc's outer six sevenths, by its radius:
/// 2/3 (1 - a^3) / (1 - a^2) with a^2 = 1/7.
constexpr double ring_radius = 0.7359;
/// Divergence of a beam that is a line but has to measure its incidence: wide enough for differences, too thin to mix
/// edges.
constexpr double thin_cone = 2e-4;

/// Returns two directions perpendicular to `d` and to each other.
std::pair<Vec3, Vec3> across(const Vec3& d) {
  const Vec3 other = std::abs(d.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 left = other.cross(d).normalized();
  return {left, d.cross(left)};
}

}  // namespace

Beam::Beam(double divergence)
    : is_line_(divergence <= 0),
      tangent_(ring_radius * elementary::tan(0.5 * (divergence > 0 ? divergence : thin_cone))) {
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const double a = double(k) * std::numbers::pi / 3;
    const auto [sine, cosine] = elementary::sincos(a);
    ring_[k] = tangent_ * Eigen::Vector2d(cosine, sine);
  }
}

RaySet Beam::widened(const RaySet& set) const {
  RaySet wide;
  wide.spacing = set.spacing;
  for (const Vec3& d : set.directions) {
    const auto [left, up] = across(d);
    wide.directions.push_back(d);
    for (const Eigen::Vector2d& at : ring_) {
      const Vec3 outer = d + at.x() * left + at.y() * up;
      wide.directions.push_back(outer.normalized());
    }
  }
  wide.columns = wide.size();
  return wide;
}

Beam::Reading Beam::read(const double* ranges, double no_return) const {
  Reading r{.range = no_return};
  if (is_line_ && ranges[0] >= no_return) return r;
  double sum_of_weights = 0, weighted_sum = 0, nearest = no_return;
  for (std::uint32_t k = 0; k < rays; ++k) {
    if (ranges[k] >= no_return) continue;
    const double weight = 1 / std::max(ranges[k] * ranges[k], 1e-12);
    sum_of_weights += weight;
    weighted_sum += weight * ranges[k];
    if (ranges[k] < nearest) nearest = ranges[k], r.main_ray = k;
  }
  if (sum_of_weights <= 0) return r;
  r.range = is_line_ ? ranges[0] : weighted_sum / sum_of_weights;
  if (ranges[0] < no_return) r.main_ray = 0;

  // On a flat surface 1 / (depth along the central ray) is linear in the position on the plane at distance 1. Each
  // triangle of the central ray and two neighbours on the ring gives a normal; triangles across an edge are steep.
  const auto inverse = [&](std::uint32_t k) {
    const double depth = ranges[k] / (k == 0 ? 1 : std::sqrt(1 + tangent_ * tangent_));
    return ranges[k] < no_return ? 1 / std::max(depth, 1e-9) : 0.0;
  };
  if (r.main_ray != 0) return r;
  double min_slope = std::numeric_limits<double>::infinity();
  const double w = inverse(0);
  for (std::uint32_t k = 0; k < rays - 1; ++k) {
    const std::uint32_t next = (k + 1) % (rays - 1);
    const Eigen::Vector2d &p = ring_[k], &q = ring_[next];
    const double a = inverse(k + 1) - w, b = inverse(next + 1) - w, determinant = p.x() * q.y() - p.y() * q.x();
    const double x = (a * q.y() - b * p.y()) / determinant, y = (b * p.x() - a * q.x()) / determinant;
    min_slope = std::min(min_slope, std::sqrt(x * x + y * y));
  }
  r.incidence = elementary::atan2(min_slope, w);
  return r;
}

}  // namespace muro::scanner
