// SPDX-License-Identifier: MIT
// Balls and capsules on a heightmap: all points within a radius of a segment.
#include <algorithm>
#include <cmath>

#include "shape_contacts.hpp"

namespace muro::terrain_contact {

namespace {

/// Adds contacts with the surface within reach of an end of the segment; the end may be under the surface.
void add_end(const Surface& surface, const Vec3& end, double radius, ContactCollector& contacts) {
  const double reach = radius + contacts.margin();
  if (const auto ground = surface.map().ground_at(end.x(), end.y()); ground && end.z() < ground->height) {
    contacts.add_on_shape(end - radius * ground->normal, ground->normal,
                          (end.z() - ground->height) * ground->normal.z() - radius);
    return;
  }
  // With the slack, a foot on an edge belongs to both triangles even if rounding keeps them out of one plane.
  const double slack = 2e-4 * reach;
  surface.each_triangle({end.array() - reach, end.array() + reach}, [&](const Surface::Triangle& t) {
    const double height = t.height_of(end);
    if (height < 0 || height > reach || !surface.covers(t, end - height * t.normal, slack)) return;
    contacts.add_on_shape(end - radius * t.normal, t.normal, height - radius);
  });
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  return length > 0 ? Vec3(a + std::clamp(along.dot(p - a) / length, 0.0, 1.0) * along) : a;
}

/// Finds the nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9). Returns that of the edge,
/// as a part of it; `on_axis`: that of the axis from `a` to `b`.
double part_nearest_to(const SurfaceEdge& edge, const Vec3& a, const Vec3& b, Vec3& on_axis) {
  const Vec3 along = edge.end - edge.begin, axis = b - a, between = edge.begin - a;
  const double e = along.squaredNorm(), f = axis.squaredNorm(), c = along.dot(between);
  if (!(f > 0)) {
    on_axis = a;
    return std::clamp(-c / e, 0.0, 1.0);
  }
  const double d = along.dot(axis), g = axis.dot(between), denominator = e * f - d * d;
  const double s = denominator > 1e-9 * e * f ? std::clamp((d * g - c * f) / denominator, 0.0, 1.0) : 0.5;
  const double t = std::clamp((d * s + g) / f, 0.0, 1.0);
  on_axis = a + t * axis;
  return std::clamp((t * d - c) / e, 0.0, 1.0);
}

}  // namespace

void add_round_contacts(const Surface& surface, const Vec3& a, const Vec3& b, double radius,
                        ContactCollector& contacts) {
  add_end(surface, a, radius, contacts);
  if (a != b) add_end(surface, b, radius, contacts);
  const double reach = radius + contacts.margin();
  const Aabb box{a.cwiseMin(b).array() - reach, a.cwiseMax(b).array() + reach};
  surface.each_ridge(box, [&](const SurfaceEdge& edge) {
    Vec3 on_axis;
    const double part = part_nearest_to(edge, a, b, on_axis);
    if (part == 0 || part == 1) return;
    const Vec3 point = edge.begin + part * (edge.end - edge.begin), apart = on_axis - point;
    const double distance = apart.norm();
    if (distance > reach || !(distance > 0) || !edge.allows(apart / distance)) return;
    contacts.add_on_terrain(point, apart / distance, distance - radius);
  });
  surface.each_node(box, [&](std::uint32_t column, std::uint32_t row) {
    const Vec3 point = surface.map().node(column, row), apart = nearest_on_segment(a, b, point) - point;
    const double distance = apart.norm();
    if (distance > reach || !(distance > 0) || !surface.allows(column, row, apart / distance)) return;
    contacts.add_on_terrain(point, apart / distance, distance - radius);
  });
}

}  // namespace muro::terrain_contact
