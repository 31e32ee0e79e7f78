// SPDX-License-Identifier: MIT
#include "pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace muro::raycast {

namespace {

constexpr std::uint32_t bundles_per_sector = 8;
constexpr double rounding = 1e-12;  // bounds are wider by this, so that rounding cannot make them cut a ray

Vec3 ray_of(const Bundle& b, std::uint32_t i) { return {b.x[i], b.y[i], b.z[i]}; }

/// The cone about `axis` (not normalised, the sum of directions) whose half angle has this cosine.
Cone cone_about(const Vec3& axis, double cosine) {
  if (cosine < rounding) return {};
  const double c = cosine - rounding;
  return {axis.normalized(), c, std::sqrt(1 - c * c)};
}

/// Four planes through the origin around the rays of a bundle: the sides of the smallest rectangle around them in
/// the plane of projection at distance 1 along the axis of the cone.
void enclose(Bundle& b) {
  std::fill_n(b.nx, 4, 0.0);
  std::fill_n(b.ny, 4, 0.0);
  std::fill_n(b.nz, 4, 0.0);
  if (b.cone.cosine < 0.2) return;  // too wide for a projection: the zero normals let everything through
  const Vec3& m = b.cone.axis;
  const Vec3 across = std::abs(m.z()) < 0.99 ? Vec3::UnitZ().cross(m) : Vec3::UnitX().cross(m);
  const Vec3 sides[2] = {across.normalized(), m.cross(across).normalized()};
  for (int k = 0; k < 2; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t i = 0; i < b.count; ++i) {
      const Vec3 d = ray_of(b, i);
      const double at = sides[k].dot(d) / m.dot(d);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    const Vec3 normals[2] = {(sides[k] - (low - rounding) * m).normalized(),
                             ((high + rounding) * m - sides[k]).normalized()};
    for (int j = 0; j < 2; ++j) {
      b.nx[2 * k + j] = normals[j].x();
      b.ny[2 * k + j] = normals[j].y();
      b.nz[2 * k + j] = normals[j].z();
    }
  }
}

}  // namespace

Vec3 direction_of(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

bool Grid::full_circle() const { return columns > 1 && std::abs(max_angle - min_angle - 2 * std::numbers::pi) < 1e-9; }

double Grid::first_angle() const { return columns > 1 ? min_angle : 0.5 * (min_angle + max_angle); }

double Grid::angle_increment() const {
  if (columns == 1) return 0;
  return (max_angle - min_angle) / (full_circle() ? columns : columns - 1);
}

double Grid::elevation(std::uint32_t row) const {
  if (rows == 1) return 0.5 * (min_elevation + max_elevation);
  const double share = double(row) / (rows - 1);
  return (1 - share) * min_elevation + share * max_elevation;
}

Pattern::Pattern(const Grid& grid) : size_(grid.rows * grid.columns) {
  // Tiles of 1 x 16, 2 x 8 or 4 x 4 rays: the squarer, the narrower their cones.
  const std::uint32_t tall = grid.rows % 4 == 0 ? 4 : grid.rows % 2 == 0 ? 2 : 1, wide = Bundle::size / tall;
  const double first = grid.first_angle(), increment = grid.angle_increment();
  for (std::uint32_t row = 0; row < grid.rows; row += tall) {
    for (std::uint32_t column = 0; column < grid.columns; column += wide) {
      Bundle bundle;
      for (std::uint32_t r = row; r < row + tall; ++r)
        for (std::uint32_t c = column; c < std::min(column + wide, grid.columns); ++c) {
          const bool last = c > 0 && c == grid.columns - 1 && !grid.full_circle();
          const double azimuth = last ? grid.max_angle : first + c * increment;
          add(direction_of(azimuth, grid.elevation(r)), r * grid.columns + c, bundle);
        }
      close(bundle);
    }
  }
  make_sectors();
}

Pattern::Pattern(std::span<const double> pairs) : size_(std::uint32_t(pairs.size() / 2)) {
  for (std::uint32_t ray = 0; ray < size_;) {
    Bundle bundle;
    for (; ray < size_ && bundle.count < Bundle::size; ++ray)
      add(direction_of(pairs[2 * ray], pairs[2 * ray + 1]), ray, bundle);
    close(bundle);
  }
  make_sectors();
}

void Pattern::add(const Vec3& d, std::uint32_t ray, Bundle& b) {
  b.x[b.count] = d.x();
  b.y[b.count] = d.y();
  b.z[b.count] = d.z();
  b.ray[b.count++] = ray;
  // Above 89.9 degrees the slope bounds nothing any more.
  const double flat = std::hypot(d.x(), d.y());
  const double slope = flat > 1.7e-3 ? d.z() / flat : std::copysign(std::numeric_limits<double>::infinity(), d.z());
  const bool first = bundles_.empty() && b.count == 1;
  min_slope_ = first ? slope : std::min(min_slope_, slope);
  max_slope_ = first ? slope : std::max(max_slope_, slope);
}

void Pattern::close(Bundle& b) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < b.count; ++i) sum += ray_of(b, i);
  const Vec3 axis = sum.norm() > 1e-6 ? sum.normalized() : Vec3(Vec3::Zero());
  double cosine = 1;
  for (std::uint32_t i = 0; i < b.count; ++i) cosine = std::min(cosine, axis.dot(ray_of(b, i)));
  b.cone = cone_about(axis, cosine);
  enclose(b);
  for (std::uint32_t i = b.count; i < Bundle::size; ++i) {
    b.x[i] = b.x[b.count - 1];
    b.y[i] = b.y[b.count - 1];
    b.z[i] = b.z[b.count - 1];
    b.ray[i] = b.ray[b.count - 1];
  }
  bundles_.push_back(b);
}

void Pattern::make_sectors() {
  const std::uint32_t n = std::uint32_t(bundles_.size());
  for (std::uint32_t first = 0; first < n; first += bundles_per_sector) {
    Sector s{first, std::min(bundles_per_sector, n - first), {}};
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t b = first; b < first + s.count; ++b)
      for (std::uint32_t i = 0; i < bundles_[b].count; ++i) sum += ray_of(bundles_[b], i);
    const Vec3 axis = sum.norm() > 1e-6 ? sum.normalized() : Vec3(Vec3::Zero());
    double cosine = 1;
    for (std::uint32_t b = first; b < first + s.count; ++b)
      for (std::uint32_t i = 0; i < bundles_[b].count; ++i) cosine = std::min(cosine, axis.dot(ray_of(bundles_[b], i)));
    s.cone = cone_about(axis, cosine);
    sectors_.push_back(s);
  }
}

}  // namespace muro::raycast
