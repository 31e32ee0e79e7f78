// SPDX-License-Identifier: MIT
#include "pairs/penetration_depth.hpp"

#include <algorithm>

#include "pairs/gjk.hpp"
#include "pairs/rim_patch.hpp"

namespace muro::native {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vec2 left_of(const Vec2& a) { return {-a.y(), a.x()}; }

/// Returns the point of a box or cylinder that lies farthest along the unit vector n; if there are many, one in their
/// middle.
Vec3 support_point(const TransformedShape& shape, const Vec3& n) {
  constexpr double level = 1e-9;
  Vec3 p = shape.centre;
  const Vec3 c = shape.axes.transpose() * n;
  for (int k = shape.kind == ShapeKind::box ? 0 : 2; k < 3; ++k)
    if (std::abs(c[k]) > level) p += std::copysign(shape.half[k], c[k]) * shape.axes.col(k);
  if (shape.kind == ShapeKind::box) return p;
  const double across = std::sqrt(c[0] * c[0] + c[1] * c[1]);
  if (across > level) p += (shape.axes.col(0) * c[0] + shape.axes.col(1) * c[1]) * (shape.radius() / across);
  return p;
}

/// Returns the radius (m) of the largest ball about `point` that lies in a box or cylinder; negative outside.
double inscribed_radius(const TransformedShape& shape, const Vec3& point) {
  const Vec3 p = shape.axes.transpose() * (point - shape.centre);
  if (shape.kind == ShapeKind::box) return (shape.half - p.cwiseAbs()).minCoeff();
  return std::min(shape.half.z() - std::abs(p.z()), shape.radius() - std::sqrt(p.x() * p.x() + p.y() * p.y()));
}

struct Strip;
struct OtherSegments;

/// The least value of the depth function found so far, and the search for a lower one.
struct Search {
  const DepthFunction& h;
  double min_depth = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ();

  void consider(const Vec3& n, double value) {
    if (value >= min_depth) return;
    min_depth = value;
    normal = n;
  }
  void consider(const Vec3& n) { consider(n, h(n)); }
  /// Considers the better of n and -n.
  void consider_axis(const Vec3& n) { consider(n.dot(h.offset) > 0 ? Vec3(-n) : n); }

  /// Returns false if a face separates the shapes.
  bool flat_faces() {
    for (int j = 0; j < h.discs; ++j) consider_axis(h.disc[j]);
    if (min_depth + h.ball <= 0) return false;
    for (int k = 0; k < h.segments; ++k)
      for (int m = k + 1; m < h.segments; ++m) {
        const Vec3 n = h.axis[k].cross(h.axis[m]);
        const double sine2 = n.squaredNorm();
        if (sine2 > 1e-20) consider_axis(n / std::sqrt(sine2));
        if (min_depth + h.ball <= 0) return false;
      }
    return true;
  }

  /// Whether no depth is less: a ball of radius `min_depth` about a point of one shape lies in the other, which must
  /// then move by that much in any direction. Not every minimum can be proven in this way, but most can where a face is
  /// touched.
  bool is_minimum() const {
    const double reach = min_depth * (1 - 1e-9);
    return h.ball == 0 && (inscribed_radius(h.first, support_point(h.second, normal)) >= reach ||
                           inscribed_radius(h.second, support_point(h.first, -normal)) >= reach);
  }

  void normals_across(int segment);
  void search_strip(const Strip& strip, const OtherSegments& others, const Vec2& offset, double along, double reach);
  void around_corners(const Vec3& a, const Vec3& b, const Vec2& offset, const Vec2* edges, int count);
  bool newton(const Vec3& n, Vec3& step) const;
  void descend(Vec3 n);
  void rims();
  void triangle(const RimPatch& patch, const Vec3& a, const Vec3& b, const Vec3& c);
};

/// The segments except one, seen along that one: their half vectors across it, and their extents along it.
struct OtherSegments {
  Vec2 across[3];
  double along[3];
  int count = 0;
};

/// The function h on the normals n = x a + y b at right angles to one segment, where no kink lies between p and q:
/// d . (x, y) + radius sqrt(y^2 + flat x^2) + constant.
struct Strip {
  Vec3 a, b;
  double radius, flat, constant;

  /// Whether there may be a minimum not above `bound` in the quadrant of m. At a minimum, the farthest point of the
  /// strip, d + radius * (a point of an ellipse) + constant * n, is n times the minimum.
  bool may_hold_minimum(const Vec2& d, const Vec2& m, double bound) const {
    const double x = m.x() < 0 ? d.x() : -d.x(), y = -d.y(), wide = radius * std::sqrt(flat);
    if (std::min(x, y) < -bound || x > wide + constant + bound || y > radius + constant + bound) return false;
    return constant > 0 || std::abs(std::sqrt(flat * y * y + x * x) - wide) <= bound;
  }

  double root(const Vec2& m) const { return std::sqrt(m.y() * m.y() + flat * m.x() * m.x()); }
  double slope(const Vec2& d, const Vec2& m, double r) const {
    const double s = r > 0 ? m.y() / r : 1;  // the limit from above the x axis
    return d.dot(left_of(m)) + radius * (1 - flat) * m.x() * s;
  }

  void search(Search& s, const Vec2& d, double sign, const Vec2& p, const Vec2& q) const {
    const Vec2 m = (p + q).normalized();
    const double r = root(m), value = d.dot(m) + radius * r, by = slope(d, m, r), cosine = m.dot(p);
    const double level = value > 0 ? value * cosine : value;
    const double sine = std::abs(cross(m, p));
    const auto may_be_lower = [&](double descent) { return level - descent * sine + constant < s.min_depth; };
    if (!may_be_lower(std::abs(by))) return;
    if (cosine < 0.999) {  // it falls to one side only
      if (may_be_lower(std::max(by, 0.0))) search(s, d, sign, p, m);
      if (may_be_lower(std::max(-by, 0.0))) search(s, d, sign, m, q);
      return;
    }
    if (slope(d, p, root(p)) <= 0 && slope(d, q, root(q)) >= 0) {
      const Vec2 x = sign * minimum(d, p, q);
      s.consider((x.x() * a + x.y() * b).normalized());
    }
  }

  /// Finds the minimum between p and q by Newton's method, and by halving where that leaves the bracket. The slope is
  /// not positive at p and not negative at q.
  Vec2 minimum(const Vec2& d, Vec2 p, Vec2 q) const {
    Vec2 x = (p + q).normalized();
    for (int round = 0; round < 40; ++round) {
      const double r = root(x), by = slope(d, x, r);
      (by < 0 ? p : q) = x;
      const double bend = radius * flat / (r * r * r) - d.dot(x) - radius * r;  // second derivative
      const double step = -by / bend;
      if (std::abs(step) < 1e-15) break;
      const Vec2 next = (x + step * left_of(x)).normalized();
      const bool in = bend > 0 && cross(p, next) > 0 && cross(next, q) > 0;
      x = in ? next : (p + q).normalized();
    }
    return x;
  }
};

void Search::normals_across(int segment) {
  const Vec3 u = h.axis[segment];
  Strip strip{Vec3::Zero(), Vec3::Zero(), 0, 1, 0};
  bool bent = false;
  double reach = h.half[segment] * (1 + 1e-9);  // of the strip's farthest points along u
  for (int j = 0; j < h.discs; ++j) {
    const double along = h.disc[j].dot(u);
    Vec3 side = h.disc[j] - along * u;
    if (side.squaredNorm() < 1e-16) {  // seen from the front: a circle
      strip.constant += h.radius[j];
      continue;
    }
    bent = true;
    strip.radius = h.radius[j];
    strip.flat = along * along;
    reach += h.radius[j] * side.norm();
    side.normalize();
    strip.a = (side - side.dot(u) * u).normalized();
  }
  if (!bent) strip.a = perpendicular(u);
  strip.b = u.cross(strip.a);

  const Vec2 offset(strip.a.dot(h.offset), strip.b.dot(h.offset));
  OtherSegments others;
  for (int k = 0; k < h.segments; ++k) {
    if (k == segment) continue;
    others.along[others.count] = h.half[k] * u.dot(h.axis[k]);
    others.across[others.count++] = h.half[k] * Vec2(strip.a.dot(h.axis[k]), strip.b.dot(h.axis[k]));
  }
  if (!bent) return around_corners(strip.a, strip.b, offset, others.across, others.count);
  search_strip(strip, others, offset, u.dot(h.offset), reach);
}

/// Searches the upper half circle, one interval after the other, between kinks (normals of an edge) and the axes of the
/// ellipse. The lower half is its mirror image with -offset. `along`: part of the offset along the segment.
void Search::search_strip(const Strip& strip, const OtherSegments& others, const Vec2& offset, double along,
                          double reach) {
  Vec2 bounds[6] = {{1, 0}, {0, 1}, {-1, 0}};  // of the intervals, in order of their angle
  int count = 3;
  for (int k = 0; k < others.count; ++k) {
    const double length = others.across[k].norm();
    if (length < 1e-12 * h.half[0]) continue;
    const Vec2 kink = left_of(others.across[k]) / length;
    const Vec2 upper = kink.y() < 0 ? Vec2(-kink) : kink;
    int i = count++;
    for (; i > 1 && bounds[i - 1].x() < upper.x(); --i) bounds[i] = bounds[i - 1];
    bounds[i] = upper;
  }
  for (int i = 0; i + 1 < count; ++i) {
    const Vec2 &p = bounds[i], &q = bounds[i + 1];
    if (cross(p, q) < 1e-12) continue;
    const Vec2 m = p + q;
    Vec2 corner = Vec2::Zero();
    double corner_along = 0;
    for (int k = 0; k < others.count; ++k) {
      const double side = std::copysign(1.0, others.across[k].dot(m));
      corner += side * others.across[k];
      corner_along += side * others.along[k];
    }
    for (const double sign : {1.0, -1.0}) {
      const Vec2 d = corner + sign * offset;
      if (std::abs(corner_along + sign * along) <= reach && strip.may_hold_minimum(d, m, std::max(min_depth, 0.0)))
        strip.search(*this, d, sign, p, q);
    }
  }
}

/// Handles a polygon swept by a circle, or by nothing: the least depth lies on the line from a corner to the origin.
void Search::around_corners(const Vec3& a, const Vec3& b, const Vec2& offset, const Vec2* edges, int count) {
  const double scale = h.offset.cwiseAbs().maxCoeff() + h.half[0];
  for (int signs = 0; signs < 1 << count; ++signs) {
    Vec2 corner = offset;
    for (int k = 0; k < count; ++k) corner += (signs >> k & 1 ? 1.0 : -1.0) * edges[k];
    const double length = corner.norm();
    // All directions are equally good on the axis itself.
    consider(length > 1e-12 * scale ? Vec3((corner.x() * a + corner.y() * b) * (-1 / length)) : a);
  }
}

/// Computes Newton's step on the unit sphere from n, in its tangent plane. With t = disc x n / |disc x n| a disc bends
/// h by radius / |disc x n| along t; moving on the sphere subtracts h itself. Returns false if h has no minimum nearby;
/// then the step is one along the negative gradient.
bool Search::newton(const Vec3& n, Vec3& step) const {
  const Vec3 a = perpendicular(n), b = n.cross(a);
  Vec3 gradient = h.offset;
  for (int k = 0; k < h.segments; ++k) gradient += std::copysign(h.half[k], n.dot(h.axis[k])) * h.axis[k];
  double aa = 0, ab = 0, bb = 0;
  for (int j = 0; j < h.discs; ++j) {
    const Vec3 across = n - n.dot(h.disc[j]) * h.disc[j];
    const double length = across.norm();
    if (length < 1e-9) continue;
    gradient += across * (h.radius[j] / length);
    const Vec3 t = h.disc[j].cross(across) / length;
    const double bend = h.radius[j] / length, ta = t.dot(a), tb = t.dot(b);
    aa += bend * ta * ta, ab += bend * ta * tb, bb += bend * tb * tb;
  }
  const double plain = gradient.dot(n), ga = gradient.dot(a), gb = gradient.dot(b);
  aa -= plain, bb -= plain;
  const double determinant = aa * bb - ab * ab;
  if (aa > 0 && determinant > 1e-12 * aa * bb) {
    step = ((ab * gb - bb * ga) * a + (ab * ga - aa * gb) * b) / determinant;
    return true;
  }
  step = (ga * a + gb * b) * (-0.3 / (std::sqrt(ga * ga + gb * gb) + 1e-300));
  return false;
}

/// Descends from n by Newton's method.
void Search::descend(Vec3 n) {
  double value = h(n);
  for (int round = 0; round < 20; ++round) {
    Vec3 step;
    newton(n, step);
    const double length = step.norm();
    if (length < 1e-15) break;
    if (length > 0.5) step *= 0.5 / length;
    bool lower = false;
    for (int halving = 0; halving < 6 && !lower; ++halving, step *= 0.5) {
      const Vec3 next = (n + step).normalized();
      const double then = h(next);
      if (then >= value) continue;
      lower = true;
      n = next;
      value = then;
    }
    if (!lower) break;
  }
  consider(n, value);
}

/// Searches where both rims meet. The great circles at right angles to the axes, across which h has kinks, and the one
/// through both axes cut the sphere into eight triangles.
void Search::rims() {
  const Vec3 side = h.disc[0].cross(h.disc[1]);
  const double sine = side.norm();
  if (sine < 1e-9) return;
  const Vec3 w = side / sine, e0 = h.disc[0].cross(w), e1 = h.disc[1].cross(w);
  for (const double s0 : {1.0, -1.0})
    for (const double s1 : {1.0, -1.0}) {
      const RimPatch patch(h, s0, s1);
      if (patch.minima_are_near_axes(sine, min_depth)) {
        if (const auto start = patch.minimum_near_axes(sine, min_depth)) descend(*start);
        continue;
      }
      for (const double up : {1.0, -1.0})
        if (patch.may_hold_minimum(up * w, sine, min_depth)) triangle(patch, -s1 * e0, s0 * e1, up * w);
    }
}

/// Searches a triangle by branch and bound: with the point p of the difference that is outermost along the middle, h(n)
/// >= p . n. At a disc's axis h has the tip of a cone, so triangles get smaller towards it before Newton's method is
/// tried.
void Search::triangle(const RimPatch& patch, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 m = (a + b + c).normalized();
  const Vec3 p = patch.support(m);
  if (std::min({p.dot(a), p.dot(b), p.dot(c)}) >= std::max(min_depth, 0.0)) return;
  const double wide = std::sqrt(std::max({(a - m).squaredNorm(), (b - m).squaredNorm(), (c - m).squaredNorm()}));
  const double tip = std::sqrt(std::min(m.cross(h.disc[0]).squaredNorm(), m.cross(h.disc[1]).squaredNorm()));
  if (wide > 1e-3 && wide > std::min(0.15, 0.5 * tip)) {
    const Vec3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
    triangle(patch, ab, bc, ca);
    triangle(patch, a, ab, ca);
    triangle(patch, b, bc, ab);
    triangle(patch, c, ca, bc);
    return;
  }
  Vec3 step;
  if (newton(m, step) && step.norm() < 3 * wide) descend(m);
}

}  // namespace

Penetration penetration_depth(const DepthFunction& h) {
  Search search{h};
  if (!search.flat_faces()) return {};
  if (h.discs > 0)  // otherwise all faces are flat
    for (int k = h.segments; k-- > 0 && !search.is_minimum();) search.normals_across(k);
  if (!search.is_minimum()) {
    const Separation cores = separation(h);
    if (cores.relation == Relation::apart) return {};
    if (cores.relation == Relation::near) search.descend(cores.direction);
    if (cores.relation == Relation::inside && h.discs == 2) search.rims();
  }
  return {search.min_depth + h.ball, search.normal};
}

}  // namespace muro::native
