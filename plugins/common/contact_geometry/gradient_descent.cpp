// SPDX-License-Identifier: MIT
#include "gradient_descent.hpp"

#include "muro/base/elementary.hpp"

namespace muro::contact_geometry {
namespace {

/// Returns p_b(n) - p_a(-n), m.
Vec3 depth_gradient(const CollisionObject& a, const CollisionObject& b, const Vec3& n) {
  return support_point(b, n) - support_point(a, Vec3(-n));
}

/// Calls `use` with the directions of edges and axes of a primitive. For a box and for the ends of a cylinder these are
/// also the face normals.
template <class Use>
void each_axis(const CollisionObject& s, Use use) {
  if (s.geometry->hull || s.shape.kind == ShapeKind::sphere) return;
  for (int k = s.shape.kind == ShapeKind::box ? 0 : 2; k < 3; ++k) use(Vec3(s.shape.axes.col(k)));
}

/// Calls `use` with the normals of flat faces; for a hull, with those that point roughly along `direction`.
template <class Use>
void each_face(const CollisionObject& s, const Vec3& direction, Use use) {
  if (!s.geometry->hull) {
    if (s.shape.kind != ShapeKind::capsule) each_axis(s, use);
    return;
  }
  const Vec3 local = s.pose.orientation.conjugate() * direction;
  int remaining = 32;
  for (const mesh::Hull::Face& f : s.geometry->hull->faces)
    if (f.normal.dot(local) > 0.7 && remaining-- > 0) use(Vec3(s.pose.orientation * f.normal));
}

/// The best direction found so far, and the search for a better one.
class Search {
 public:
  Search(const CollisionObject& a, const CollisionObject& b, const Vec3& start) : a_(a), b_(b), best_(start) {
    gradient_ = depth_gradient(a, b, start);
    min_depth_ = start.dot(gradient_);
  }
  const Vec3& best() const { return best_; }

  bool consider(const Vec3& n) {
    const Vec3 g = depth_gradient(a_, b_, n);
    if (n.dot(g) >= min_depth_) return false;
    min_depth_ = n.dot(g), best_ = n, gradient_ = g;
    return true;
  }
  void consider_both(const Vec3& n) { consider(n), consider(Vec3(-n)); }

  /// Searches all directions at right angles to `axis`, where the gradient of the depth is discontinuous.
  void search_crease(const Vec3& axis) {
    constexpr int samples = 16;
    const Vec3 x = perpendicular(axis), y = axis.cross(x);
    const auto direction = [&](double angle) {
      const auto [sine, cosine] = elementary::sincos(angle);
      return Vec3(cosine * x + sine * y);
    };
    const auto depth_at = [&](double angle) {
      const Vec3 n = direction(angle);
      return n.dot(depth_gradient(a_, b_, n));
    };
    double angle = 0, least = depth_at(0);
    const auto better = [&](double other) {
      const double depth = depth_at(other);
      if (depth >= least) return false;
      least = depth, angle = other;
      return true;
    };
    for (int i = 1; i < samples; ++i) better(2 * M_PI * i / samples);
    for (double step = M_PI / samples; step > 1e-9;)
      if (!better(angle + step) && !better(angle - step)) step *= 0.4;
    consider(direction(angle));
  }

  void descend() {
    for (double step = 0.1; step > 1e-8;) {
      const Vec3 across = gradient_ - best_.dot(gradient_) * best_;
      const double steep = across.norm();
      if (!(steep > 0)) break;
      step *= consider((best_ - step / steep * across).normalized()) ? 1.3 : 0.5;
    }
  }

 private:
  const CollisionObject& a_;
  const CollisionObject& b_;
  Vec3 best_, gradient_;
  double min_depth_ = 0;
};

}  // namespace

Vec3 minimum_translation_direction(const CollisionObject& a, const CollisionObject& b, const Vec3& start) {
  Search search(a, b, start);
  search.descend();
  const auto face = [&](const Vec3& n) { search.consider_both(n); };
  each_face(a, Vec3(-start), face);
  each_face(b, start, face);
  each_axis(a, [&](const Vec3& u) {
    each_axis(b, [&](const Vec3& v) {
      const Vec3 across = u.cross(v);
      if (across.squaredNorm() > 1e-8) search.consider_both(across.normalized());
    });
  });
  const auto crease = [&](const Vec3& axis) { search.search_crease(axis); };
  each_axis(a, crease);
  each_axis(b, crease);
  search.descend();
  return search.best();
}

}  // namespace muro::contact_geometry
