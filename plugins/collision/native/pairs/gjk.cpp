// SPDX-License-Identifier: MIT
#include "pairs/gjk.hpp"

#include "hulls/convex_core.hpp"

namespace muro::native {
namespace {

/// Up to four points of the difference. `nearest` keeps those that carry the nearest point.
struct Simplex {
  Vec3 p[4];
  int count = 0;

  Vec3 keep(const Vec3& a) {
    p[0] = a;
    count = 1;
    return a;
  }
  Vec3 keep(const Vec3& a, const Vec3& b, double t) {
    p[0] = a, p[1] = b;
    count = 2;
    return a + t * (b - a);
  }

  Vec3 nearest_on_segment() {
    const Vec3 a = p[0], b = p[1], ab = b - a;
    const double t = -a.dot(ab), length2 = ab.squaredNorm();
    if (t <= 0) return keep(a);
    if (t >= length2) return keep(b);
    return keep(a, b, t / length2);
  }

  Vec3 nearest_on_triangle() {
    const Vec3 a = p[0], b = p[1], c = p[2], ab = b - a, ac = c - a;
    const double d1 = -ab.dot(a), d2 = -ac.dot(a);
    if (d1 <= 0 && d2 <= 0) return keep(a);
    const double d3 = -ab.dot(b), d4 = -ac.dot(b);
    if (d3 >= 0 && d4 <= d3) return keep(b);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return keep(a, b, d1 / (d1 - d3));
    const double d5 = -ab.dot(c), d6 = -ac.dot(c);
    if (d6 >= 0 && d5 <= d6) return keep(c);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return keep(a, c, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return keep(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    // Inside: the foot of the perpendicular is more exact than barycentric sums.
    const Vec3 n = ab.cross(ac);
    const double n2 = n.squaredNorm();
    if (!(n2 > 0)) return keep(a);
    return n * (n.dot(a) / n2);
  }

  /// Returns false if the origin is inside the tetrahedron.
  bool nearest_on_tetrahedron(Vec3& v) {
    static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    double best = std::numeric_limits<double>::infinity();
    Simplex kept;
    for (const auto& f : faces) {
      const Vec3 n = (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]]);
      const double origin = -n.dot(p[f[0]]), fourth = n.dot(p[f[3]] - p[f[0]]);
      if (origin * fourth > 0) continue;  // on the inner side of this face
      Simplex triangle;
      triangle.p[0] = p[f[0]], triangle.p[1] = p[f[1]], triangle.p[2] = p[f[2]];
      triangle.count = 3;
      const Vec3 q = triangle.nearest_on_triangle();
      if (q.squaredNorm() < best) {
        best = q.squaredNorm();
        v = q;
        kept = triangle;
      }
    }
    if (kept.count == 0) return false;
    *this = kept;
    return true;
  }

  bool nearest(Vec3& v) {
    switch (count) {
      case 1:
        v = p[0];
        return true;
      case 2:
        v = nearest_on_segment();
        return true;
      case 3:
        v = nearest_on_triangle();
        return true;
      default:
        return nearest_on_tetrahedron(v);
    }
  }
};

}  // namespace

template <class Difference>
Separation separation(const Difference& h) {
  constexpr int max_rounds = 64;
  constexpr double exact = 1e-14, gap = 1e-13;  // relative: of the squared distance, of the size
  Simplex simplex;
  Vec3 v = h.offset.squaredNorm() > 0 ? h.offset : Vec3(Vec3::UnitX());
  v = h.support(-v);
  simplex.keep(v);
  double largest2 = v.squaredNorm();
  for (int round = 0; round < max_rounds; ++round) {
    const double v2 = v.squaredNorm();
    if (v2 <= gap * gap * largest2) return {Relation::inside, Vec3::UnitZ()};
    const Vec3 w = h.support(-v);
    const double reach = v.dot(w);  // no point of the difference comes nearer along v than reach / |v|
    if (reach > 0 && reach * reach > h.ball * h.ball * v2) return {Relation::apart, Vec3::UnitZ()};
    if (v2 - reach <= exact * v2) break;
    largest2 = std::max(largest2, w.squaredNorm());
    simplex.p[simplex.count++] = w;
    Vec3 next = v;
    if (!simplex.nearest(next)) return {Relation::inside, Vec3::UnitZ()};
    if (next.squaredNorm() >= v2) break;  // rounding: it gets no nearer
    v = next;
  }
  return {Relation::near, -v.normalized()};
}

template Separation separation(const DepthFunction&);
template Separation separation(const CorePair&);

}  // namespace muro::native
