// SPDX-License-Identifier: MIT
#include "segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace muro::line_of_sight {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Length (m) below which a way through a shape is only a touch.
constexpr double touch = 1e-9;
/// Depth (m) under the ground down to which a line lies on it.
constexpr double on_the_ground = 1e-6;

/// The part of the endless line that is inside an open convex solid; empty if out <= in.
struct Inside {
  double in = -never, out = never;

  static Inside nothing() { return {never, -never}; }
  bool empty() const { return !(in < out); }
  Inside and_in(const Inside& b) const { return {std::max(in, b.in), std::min(out, b.out)}; }
  /// Returns the part in the union of both, which is convex.
  Inside or_in(const Inside& b) const {
    if (empty()) return b;
    if (b.empty()) return *this;
    return {std::min(in, b.in), std::max(out, b.out)};
  }
};

/// Returns the part where |start + t way| < half.
Inside in_slab(double start, double way, double half) {
  if (way == 0) return std::abs(start) < half ? Inside{} : Inside::nothing();
  const double a = (-half - start) / way, b = (half - start) / way;
  return {std::min(a, b), std::max(a, b)};
}

/// Returns the part where a t^2 + 2 b t + c < 0.
Inside in_round(double a, double b, double c) {
  if (a == 0) return c < 0 ? Inside{} : Inside::nothing();
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return Inside::nothing();
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

Inside in_ball(const Segment& s, const Vec3& centre, double radius) {
  const Vec3 from = s.start - centre;
  return in_round(s.way.squaredNorm(), from.dot(s.way), from.squaredNorm() - radius * radius);
}

Inside in_cylinder(const Segment& s, double radius, double length) {
  const auto from = s.start.head<2>(), way = s.way.head<2>();
  return in_round(way.squaredNorm(), from.dot(way), from.squaredNorm() - radius * radius)
      .and_in(in_slab(s.start.z(), s.way.z(), 0.5 * length));
}

Inside in_shape(const Segment& s, const Shape& shape) {
  const double radius = shape.size.x(), length = shape.size.z();
  switch (shape.kind) {
    case ShapeKind::box: {
      Inside box;
      for (int k = 0; k < 3; ++k) box = box.and_in(in_slab(s.start[k], s.way[k], 0.5 * shape.size[k]));
      return box;
    }
    case ShapeKind::sphere:
      return in_ball(s, Vec3::Zero(), radius);
    case ShapeKind::cylinder:
      return in_cylinder(s, radius, length);
    case ShapeKind::capsule:
      return in_cylinder(s, radius, length)
          .or_in(in_ball(s, {0, 0, 0.5 * length}, radius))
          .or_in(in_ball(s, {0, 0, -0.5 * length}, radius));
    default:
      return Inside::nothing();
  }
}

/// A heightmap with the nodes of its grid at whole numbers.
struct Grid {
  const Heightmap& map;

  double u(double x) const { return (x + 0.5 * map.size.x()) / map.spacing_x(); }
  double v(double y) const { return (y + 0.5 * map.size.y()) / map.spacing_y(); }
  double height(double at_u, double at_v) const {
    const double column = std::clamp(std::floor(at_u), 0.0, double(map.columns - 2));
    const double row = std::clamp(std::floor(at_v), 0.0, double(map.rows - 2));
    const float* low = &map.values[std::size_t(row) * map.columns + std::size_t(column)];
    const float* high = low + map.columns;
    const double fu = at_u - column, fv = at_v - row;
    const double value = fu + fv > 1
                             ? high[1] + (1 - fu) * (double(high[0]) - high[1]) + (1 - fv) * (double(low[1]) - high[1])
                             : low[0] + fu * (double(low[1]) - low[0]) + fv * (double(high[0]) - low[0]);
    return map.size.z() * value;
  }
};

/// Calls visit(t) where `start + t way` is a whole number, for t from `from` to `to`, until one call returns true.
template <class Visit>
bool at_whole_numbers(double start, double way, double from, double to, Visit visit) {
  if (way == 0) return false;
  const double a = start + from * way, b = start + to * way;
  const double last = std::floor(std::max(a, b));
  for (double whole = std::ceil(std::min(a, b)); whole <= last; ++whole)
    if (visit((whole - start) / way)) return true;
  return false;
}

}  // namespace

bool passes_through(const Segment& segment, const Shape& shape) {
  const Inside inside = in_shape(segment, shape);
  if (inside.empty()) return false;
  const bool holds_start = inside.in < 0 && inside.out > 0, holds_end = inside.in < 1 && inside.out > 1;
  if (holds_start || holds_end) return false;
  return (std::min(inside.out, 1.0) - std::max(inside.in, 0.0)) * segment.way.norm() > touch;
}

/// Along the segment the ground is linear between the edges of its triangles, so it is enough to test at these edges.
bool passes_under(const Segment& segment, const Heightmap& ground, double highest) {
  const auto lifted = [&](Vec3 p) {
    if (const auto at = ground.ground_at(p.x(), p.y())) p.z() = std::max(p.z(), at->height);
    return p;
  };
  const Vec3 a = lifted(segment.start), b = lifted(segment.end());
  if (std::min(a.z(), b.z()) >= highest) return false;
  const Grid grid{ground};
  const double u = grid.u(a.x()), v = grid.v(a.y()), du = grid.u(b.x()) - u, dv = grid.v(b.y()) - v;
  const double half_u = 0.5 * (ground.columns - 1), half_v = 0.5 * (ground.rows - 1);
  const auto within = [](double start, double way, double half) {
    if (way == 0 && std::abs(start) == half) return Inside{};  // along the rim
    return in_slab(start, way, half);
  };
  const Inside over = Inside{0, 1}.and_in(within(u - half_u, du, half_u)).and_in(within(v - half_v, dv, half_v));
  if (over.in > over.out) return false;
  const auto is_under = [&](double t) {
    const double z = a.z() + t * (b.z() - a.z());
    return z < grid.height(u + t * du, v + t * dv) - on_the_ground;
  };
  return is_under(over.in) || is_under(over.out) || at_whole_numbers(u, du, over.in, over.out, is_under) ||
         at_whole_numbers(v, dv, over.in, over.out, is_under) ||
         at_whole_numbers(u + v, du + dv, over.in, over.out, is_under);
}

/// Method: Moeller, Trumbore: Fast, minimum storage ray-triangle intersection, 1997.
bool crosses(const Segment& segment, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, p = segment.way.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const Vec3 from = segment.start - a, q = from.cross(ab);
  const double u = from.dot(p) / determinant, v = segment.way.dot(q) / determinant, t = ac.dot(q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

}  // namespace muro::line_of_sight
