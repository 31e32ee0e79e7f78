// SPDX-License-Identifier: MIT
// Cylinders on a heightmap: rims on triangles, and ridges in the side and the ends.
#include <algorithm>
#include <cmath>
#include <limits>

#include "shape_contacts.hpp"

namespace muro::terrain_contact {

namespace {

/// Lean (rad) of a cylinder below which it stands on points of its rim that turn with it.
constexpr double max_lean = 1e-3;

struct Cylinder {
  double radius, half;
  Pose pose;

  Vec3 axis() const { return pose.orientation * Vec3::UnitZ(); }
  /// Returns the lowest points of the rims against `up` (unit): four of the lower rim, one of the upper.
  std::array<Vec3, 5> lowest(const Vec3& up) const {
    Vec3 along = axis();
    if (along.dot(up) > 0) along = -along;
    Vec3 down = along * along.dot(up) - up;
    const double slope = down.norm();
    down = slope > max_lean ? Vec3(down / slope) : Vec3(pose.orientation * Vec3::UnitX());
    const Vec3 side = radius * along.cross(down), end = half * along;
    down *= radius;
    const Vec3& c = pose.position;
    return {c + end + down, c - end + down, c + end + side, c + end - side, c + end - down};
  }
  double reach_along(const Vec3& n) const {
    const double along = std::abs(axis().dot(n));
    return half * along + radius * std::sqrt(std::max(0.0, 1 - along * along));
  }
};

void add_rims(const Surface& surface, const Cylinder& cylinder, const Aabb& box, ContactCollector& contacts) {
  const double slack = 1e-6 * cylinder.radius;
  surface.each_triangle(box, [&](const Surface::Triangle& t) {
    if (t.height_of(cylinder.pose.position) - cylinder.reach_along(t.normal) > contacts.margin()) return;
    for (const Vec3& p : cylinder.lowest(t.normal))
      if (surface.covers(t, p, slack)) contacts.add_on_shape(p, t.normal, t.height_of(p));
  });
  if (contacts.count() > 0) return;
  for (const Vec3& p : cylinder.lowest(Vec3::UnitZ()))  // between steep triangles
    if (const auto ground = surface.map().ground_at(p.x(), p.y()))
      contacts.add_on_shape(p, ground->normal, (p.z() - ground->height) * ground->normal.z());
}

/// A ridge in a cylinder: the part of it between the side and the ends.
class RidgeInCylinder {
 public:
  RidgeInCylinder(const Surface& surface, const SurfaceEdge& edge, const Cylinder& cylinder, const Pose& back)
      : surface_(surface),
        edge_(edge),
        cylinder_(cylinder),
        from_(back * edge.begin),
        along_(back * edge.end - from_) {}

  void add_to(ContactCollector& contacts) {
    if (!clip()) return;
    const double flat = along_.head<2>().squaredNorm();
    const double nearest = flat > 0 ? -from_.head<2>().dot(along_.head<2>()) / flat : begin_;
    bool any = add_point(begin_, begin_cut_, edge_.first, contacts);
    any = add_point(end_, end_cut_, edge_.second, contacts) || any;
    if (nearest > begin_ && nearest < end_) any = add_point(nearest, Cut::inside, edge_.first, contacts) || any;
    if (any) return;
    const Vec3 point = from_ + 0.5 * (begin_ + end_) * along_;
    contacts.add_on_terrain(cylinder_.pose * point, edge_.normal,
                            -way_out(point, cylinder_.pose.orientation.conjugate() * Vec3(-edge_.normal)));
  }

 private:
  enum class Cut { node, side, end, inside };

  bool clip() {
    for (const double sign : {1.0, -1.0}) {
      const double at = cylinder_.half - sign * from_.z(), speed = sign * along_.z();
      if (!cut(at, speed, Cut::end)) return false;
    }
    const double a = along_.head<2>().squaredNorm(), b = from_.head<2>().dot(along_.head<2>()),
                 c = from_.head<2>().squaredNorm() - cylinder_.radius * cylinder_.radius;
    if (!(a > 1e-18)) return c < 0;
    const double root = b * b - a * c;
    if (root <= 0) return false;
    const double in = (-b - std::sqrt(root)) / a, out = (-b + std::sqrt(root)) / a;
    if (in > begin_) begin_ = in, begin_cut_ = Cut::side;
    if (out < end_) end_ = out, end_cut_ = Cut::side;
    return begin_ < end_;
  }
  /// Keeps the part of the ridge in which `at` exceeds `speed` times the position along the ridge.
  bool cut(double at, double speed, Cut by) {
    if (speed == 0) return at > 0;
    const double part = at / speed;
    if (speed > 0 && part < end_) end_ = part, end_cut_ = by;
    if (speed < 0 && part > begin_) begin_ = part, begin_cut_ = by;
    return begin_ < end_;
  }

  bool add_point(double part, Cut cut, const std::uint32_t (&node)[2], ContactCollector& contacts) {
    const Vec3 point = from_ + part * along_;
    const double off = point.head<2>().norm();
    double least = std::numeric_limits<double>::infinity();
    Vec3 best;
    const auto consider = [&](const Vec3& outward, double depth) {
      const Vec3 up = cylinder_.pose.orientation * Vec3(-outward);
      if (depth >= least || !edge_.allows(up)) return;
      if (cut == Cut::node && !surface_.allows(node[0], node[1], up)) return;
      least = depth, best = up;
    };
    if (cut != Cut::side && off > 1e-9 * cylinder_.radius)
      consider({point.x() / off, point.y() / off, 0}, cylinder_.radius - off);
    if (cut != Cut::end)
      for (const double sign : {1.0, -1.0}) consider(sign * Vec3::UnitZ(), cylinder_.half - sign * point.z());
    if (!std::isfinite(least)) return false;
    contacts.add_on_terrain(cylinder_.pose * point, best, -least);
    return true;
  }

  /// Returns the way out (m) from a point inside, along a unit vector.
  double way_out(const Vec3& point, const Vec3& direction) const {
    double way = std::numeric_limits<double>::infinity();
    if (std::abs(direction.z()) > 1e-9)
      way = (cylinder_.half - std::copysign(1.0, direction.z()) * point.z()) / std::abs(direction.z());
    const double a = direction.head<2>().squaredNorm(), b = point.head<2>().dot(direction.head<2>()),
                 c = point.head<2>().squaredNorm() - cylinder_.radius * cylinder_.radius;
    if (a > 1e-18) way = std::min(way, (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a);
    return way;
  }

  const Surface& surface_;
  const SurfaceEdge& edge_;
  const Cylinder& cylinder_;
  Vec3 from_, along_;  ///< in the frame of the cylinder
  double begin_ = 0, end_ = 1;
  Cut begin_cut_ = Cut::node, end_cut_ = Cut::node;
};

}  // namespace

void add_cylinder_contacts(const Surface& surface, double radius, double length, const Pose& pose, const Aabb& box,
                           ContactCollector& contacts) {
  const Cylinder cylinder{radius, 0.5 * length, pose};
  add_rims(surface, cylinder, box, contacts);
  const Pose back = pose.inverse();
  surface.each_ridge(box,
                     [&](const SurfaceEdge& edge) { RidgeInCylinder(surface, edge, cylinder, back).add_to(contacts); });
}

}  // namespace muro::terrain_contact
