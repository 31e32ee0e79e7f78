// SPDX-License-Identifier: MIT
#include "plane_contacts.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <algorithm>

namespace muro::bullet {

namespace {

/// Collects the contact points of a shape with a plane.
class PlaneContactCollector {
 public:
  PlaneContactCollector(const btTransform& plane, ContactPoint* out)
      : normal_(from_bullet(plane.getBasis().getColumn(2))),
        offset_(normal_.dot(from_bullet(plane.getOrigin()))),
        out_(out) {}

  const Vec3& normal() const { return normal_; }
  /// Adds a point of the surface of the other shape.
  void add(const Vec3& p) {
    const double gap = normal_.dot(p) - offset_;
    if (gap <= NarrowPhase::margin) insert({p - 0.5 * gap * normal_, normal_, gap});
  }
  int count() const { return count_; }
  /// Sets the number of points that are kept: the lowest ones.
  void set_max_points(int count) { max_points_ = count; }

 private:
  void insert(const ContactPoint& p) {
    if (count_ < max_points_) {
      out_[count_++] = p;
      return;
    }
    ContactPoint* highest =
        std::max_element(out_, out_ + count_, [](const auto& x, const auto& y) { return x.gap < y.gap; });
    if (p.gap < highest->gap) *highest = p;
  }

  Vec3 normal_;
  double offset_;
  ContactPoint* out_;
  int count_ = 0, max_points_ = NarrowPhase::max_points;
};

/// rad: a cylinder with less tilt stands on points of its rim that turn with it.
constexpr double max_lean = 1e-3;

void add_cylinder(const Collider& a, const Vec3& centre, PlaneContactCollector& plane) {
  Vec3 axis = from_bullet(a.pose.getBasis().getColumn(2));
  if (axis.dot(plane.normal()) > 0) axis = -axis;  // towards the lower rim
  Vec3 down = axis * axis.dot(plane.normal()) - plane.normal();
  const double slope = down.norm();
  down = slope > max_lean ? Vec3(down / slope) : from_bullet(a.pose.getBasis().getColumn(0));
  const Vec3 side = axis.cross(down), end = 0.5 * a.size.z() * axis;
  const double r = a.size.x();
  plane.add(centre + end + r * down);
  plane.add(centre - end + r * down);
  plane.add(centre + end + r * side);
  plane.add(centre + end - r * side);
  plane.add(centre + end - r * down);
}

}  // namespace

int plane_contacts(const Collider& a, const btTransform& plane_pose, ContactPoint* out) {
  PlaneContactCollector plane(plane_pose, out);
  const Vec3 centre = from_bullet(a.pose.getOrigin());
  const btMatrix3x3& axes = a.pose.getBasis();
  switch (a.kind) {
    case ShapeKind::box: {
      plane.set_max_points(4);
      const Vec3 x = 0.5 * a.size.x() * from_bullet(axes.getColumn(0)),
                 y = 0.5 * a.size.y() * from_bullet(axes.getColumn(1)),
                 z = 0.5 * a.size.z() * from_bullet(axes.getColumn(2));
      for (int i = 0; i < 8; ++i) plane.add(centre + (i & 1 ? x : -x) + (i & 2 ? y : -y) + (i & 4 ? z : -z));
      break;
    }
    case ShapeKind::sphere:
      plane.add(centre - a.size.x() * plane.normal());
      break;
    case ShapeKind::capsule: {
      const Vec3 half = 0.5 * a.size.z() * from_bullet(axes.getColumn(2));
      plane.add(centre + half - a.size.x() * plane.normal());
      plane.add(centre - half - a.size.x() * plane.normal());
      break;
    }
    case ShapeKind::cylinder:
      add_cylinder(a, centre, plane);
      break;
    case ShapeKind::mesh: {
      const auto& hull = static_cast<const btConvexHullShape&>(*a.shape);
      for (int i = 0; i < hull.getNumPoints(); ++i) plane.add(from_bullet(a.pose * hull.getScaledPoint(i)));
      break;
    }
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      break;
  }
  return plane.count();
}

}  // namespace muro::bullet
