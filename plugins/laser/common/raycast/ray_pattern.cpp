// SPDX-License-Identifier: MIT
#include "ray_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/base/elementary.hpp"

namespace muro::raycast {

namespace {

constexpr double margin = 1e-12;  // bounds are wider by this

Vec3 ray_of(const RayPacket& b, std::uint32_t i) { return {b.x[i], b.y[i], b.z[i]}; }

/// Returns the frustum of the smallest rectangle around the rays on the plane at distance 1 along their mean direction.
Frustum enclose(std::span<const RayPacket> packets) {
  Vec3 middle = Vec3::Zero();
  for (const RayPacket& b : packets)
    for (std::uint32_t i = 0; i < b.count; ++i) middle += ray_of(b, i);
  if (middle.norm() < 1e-6) return {};
  middle.normalize();
  const Vec3 across = std::abs(middle.z()) < 0.99 ? Vec3::UnitZ().cross(middle) : Vec3::UnitX().cross(middle);
  const Vec3 sides[2] = {across.normalized(), middle.cross(across).normalized()};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
  for (const RayPacket& b : packets)
    for (std::uint32_t i = 0; i < b.count; ++i) {
      const Vec3 d = ray_of(b, i);
      const double ahead = middle.dot(d);
      if (ahead < 0.2) return {};  // too wide for this projection
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], sides[k].dot(d) / ahead);
        high[k] = std::max(high[k], sides[k].dot(d) / ahead);
      }
    }
  Frustum f;
  for (int k = 0; k < 2; ++k) {
    const Vec3 normals[2] = {sides[k] - (low[k] - margin) * middle, (high[k] + margin) * middle - sides[k]};
    for (int j = 0; j < 2; ++j) {
      const Vec3 n = normals[j].normalized();
      f.x[2 * k + j] = float(n.x());
      f.y[2 * k + j] = float(n.y());
      f.z[2 * k + j] = float(n.z());
    }
  }
  return f;
}

}  // namespace

RayPattern::RayPattern(const RaySet& rays) : size_(rays.size()) {
  // Tiles of 4 x 4, 2 x 8 or 1 x 16 rays: tiles that are more square meet fewer boxes.
  for (std::uint32_t row = 0, tile_rows = 0; row < rays.rows; row += tile_rows) {
    const std::uint32_t left = rays.rows - row;
    tile_rows = left >= 4 ? 4 : left >= 2 ? 2 : 1;
    const std::uint32_t tile_columns = RayPacket::size / tile_rows;
    for (std::uint32_t column = 0; column < rays.columns; column += tile_columns) {
      RayPacket packet;
      for (std::uint32_t r = row; r < row + tile_rows; ++r)
        for (std::uint32_t c = column; c < std::min(column + tile_columns, rays.columns); ++c) {
          const std::uint32_t ray = r * rays.columns + c;
          add(rays.directions[ray], ray, packet);
        }
      finish(packet);
    }
  }
  make_sectors();
}

void RayPattern::add(const Vec3& d, std::uint32_t ray, RayPacket& b) {
  b.x[b.count] = d.x();
  b.y[b.count] = d.y();
  b.z[b.count] = d.z();
  b.ray[b.count++] = ray;
  // Above 89.9 degrees the slope is not a useful bound.
  const double horizontal = elementary::hypot(d.x(), d.y());
  const double slope =
      horizontal > 1.7e-3 ? d.z() / horizontal : std::copysign(std::numeric_limits<double>::infinity(), d.z());
  const bool first = packets_.empty() && b.count == 1;
  min_slope_ = first ? slope : std::min(min_slope_, slope);
  max_slope_ = first ? slope : std::max(max_slope_, slope);
}

void RayPattern::finish(RayPacket& b) {
  b.quads_are_contiguous = b.count == RayPacket::size;
  for (std::uint32_t i = 0; i < b.count; ++i)
    if (b.ray[i] != b.ray[i / 4 * 4] + i % 4) b.quads_are_contiguous = false;
  for (std::uint32_t i = b.count; i < RayPacket::size; ++i) {
    b.x[i] = b.x[b.count - 1];
    b.y[i] = b.y[b.count - 1];
    b.z[i] = b.z[b.count - 1];
    b.ray[i] = b.ray[b.count - 1];
  }
  b.frustum = enclose({&b, 1});
  packets_.push_back(b);
}

void RayPattern::make_sectors() {
  const std::uint32_t n = std::uint32_t(packets_.size());
  for (std::uint32_t first = 0; first < n; first += Sector::max_packets) {
    const std::uint32_t count = std::min(Sector::max_packets, n - first);
    sectors_.push_back({first, count, enclose(packets().subspan(first, count))});
  }
}

}  // namespace muro::raycast
