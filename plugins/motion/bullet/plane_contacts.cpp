// SPDX-License-Identifier: MIT
#include "plane_contacts.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <algorithm>

namespace muro::bullet {

namespace {

class Plane {
 public:
  Plane(const btTransform& plane, ContactPoint* out)
      : normal_(muro_of(plane.getBasis().getColumn(2))), offset_(normal_.dot(muro_of(plane.getOrigin()))), out_(out) {}

  const Vec3& normal() const { return normal_; }
  /// A point of a surface.
  void offer(const Vec3& p) {
    const double gap = normal_.dot(p) - offset_;
    if (gap <= NarrowPhase::reach) insert({p - 0.5 * gap * normal_, normal_, gap});
  }
  int count() const { return count_; }
  /// At most so many are kept, the lowest.
  void limit(int most) { most_ = most; }

 private:
  void insert(const ContactPoint& p) {
    if (count_ < most_) {
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
  int count_ = 0, most_ = NarrowPhase::most;
};

/// rad: a cylinder that leans less stands on points of its rim that turn with it.
constexpr double upright = 1e-3;

void touch_cylinder(const Collider& a, const Vec3& centre, Plane& plane) {
  Vec3 axis = muro_of(a.pose.getBasis().getColumn(2));
  if (axis.dot(plane.normal()) > 0) axis = -axis;  // towards the lower rim
  Vec3 down = axis * axis.dot(plane.normal()) - plane.normal();
  const double slope = down.norm();
  down = slope > upright ? Vec3(down / slope) : muro_of(a.pose.getBasis().getColumn(0));
  const Vec3 side = axis.cross(down), end = 0.5 * a.size.z() * axis;
  const double r = a.size.x();
  plane.offer(centre + end + r * down);
  plane.offer(centre - end + r * down);
  plane.offer(centre + end + r * side);
  plane.offer(centre + end - r * side);
  plane.offer(centre + end - r * down);
}

}  // namespace

int touch_plane(const Collider& a, const btTransform& place, ContactPoint* out) {
  Plane plane(place, out);
  const Vec3 centre = muro_of(a.pose.getOrigin());
  const btMatrix3x3& axes = a.pose.getBasis();
  switch (a.kind) {
    case ShapeKind::box: {
      plane.limit(4);
      const Vec3 x = 0.5 * a.size.x() * muro_of(axes.getColumn(0)), y = 0.5 * a.size.y() * muro_of(axes.getColumn(1)),
                 z = 0.5 * a.size.z() * muro_of(axes.getColumn(2));
      for (int i = 0; i < 8; ++i) plane.offer(centre + (i & 1 ? x : -x) + (i & 2 ? y : -y) + (i & 4 ? z : -z));
      break;
    }
    case ShapeKind::sphere:
      plane.offer(centre - a.size.x() * plane.normal());
      break;
    case ShapeKind::capsule: {
      const Vec3 half = 0.5 * a.size.z() * muro_of(axes.getColumn(2));
      plane.offer(centre + half - a.size.x() * plane.normal());
      plane.offer(centre - half - a.size.x() * plane.normal());
      break;
    }
    case ShapeKind::cylinder:
      touch_cylinder(a, centre, plane);
      break;
    case ShapeKind::mesh: {
      const auto& hull = static_cast<const btConvexHullShape&>(*a.shape);
      for (int i = 0; i < hull.getNumPoints(); ++i) plane.offer(muro_of(a.pose * hull.getScaledPoint(i)));
      break;
    }
    case ShapeKind::plane:
      break;
  }
  return plane.count();
}

}  // namespace muro::bullet
