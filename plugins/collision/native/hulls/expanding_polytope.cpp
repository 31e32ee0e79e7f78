// SPDX-License-Identifier: MIT
#include "hulls/expanding_polytope.hpp"

#include <array>
#include <limits>

#include "pairs/gjk.hpp"

namespace muro::native {
namespace {

/// A convex polytope of triangles with its corners on the surface of a Minkowski difference.
class Polytope {
 public:
  static constexpr int max_corners = 128;

  struct Face {
    int corners[3];     ///< counter-clockwise seen from outside
    int neighbours[3];  ///< across the edge that begins at corner k
    Vec3 normal;        ///< unit, outward
    double distance;    ///< m, of its plane from the origin; negative: the origin is outside
    bool is_alive, is_visible;
  };

  /// Returns false if the corners lie in a plane.
  bool start(const Vec3 (&p)[4]) {
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    const double height = n.dot(p[3] - p[0]);
    if (!(std::abs(height) > 1e-12 * n.norm() * (p[1] - p[0]).norm())) return false;
    for (int k = 0; k < 4; ++k) corners_[std::size_t(k)] = p[k];
    corner_count_ = 4;
    if (height > 0) std::swap(corners_[1], corners_[2]);
    // the fourth corner is on the back of the first face
    static constexpr int corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    static constexpr int neighbours[4][3] = {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
    for (int f = 0; f < 4; ++f) set_face(f, corners[f], neighbours[f]);
    face_count_ = 4;
    free_count_ = 0;
    return true;
  }

  /// Returns the face whose plane is nearest to the origin, or farthest on the wrong side of it.
  int nearest_face() const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < face_count_; ++f)
      if (at(f).is_alive && at(f).distance < least) least = at(f).distance, best = f;
    return best;
  }
  const Face& face(int number) const { return at(number); }

  /// Adds a point beyond a face. Returns false if there is no room, or if rounding has made the polytope unfit.
  bool expand(int seen, const Vec3& point) {
    if (corner_count_ == max_corners) return false;
    const int tip = corner_count_++;
    corners_[std::size_t(tip)] = point;
    visible_count_ = 0;
    mark(seen);
    for (int i = 0; i < visible_count_; ++i) {  // the count grows
      const Face& f = at(visible_[std::size_t(i)]);
      for (const int n : f.neighbours)
        if (!at(n).is_visible && at(n).normal.dot(point) > at(n).distance) mark(n);
    }
    return replace_visible(tip);
  }

 private:
  static constexpr int max_faces = 2 * max_corners;
  struct Edge {
    int from, to, beyond;
  };

  Face& at(int f) { return faces_[std::size_t(f)]; }
  const Face& at(int f) const { return faces_[std::size_t(f)]; }

  void mark(int f) {
    at(f).is_visible = true;
    visible_[std::size_t(visible_count_++)] = f;
  }

  void set_face(int number, const int (&corners)[3], const int (&neighbours)[3]) {
    Face& f = at(number);
    for (int k = 0; k < 3; ++k) f.corners[k] = corners[k], f.neighbours[k] = neighbours[k];
    f.is_alive = true, f.is_visible = false;
    const Vec3 &a = corners_[std::size_t(corners[0])], &b = corners_[std::size_t(corners[1])],
               &c = corners_[std::size_t(corners[2])];
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.norm(), longest = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
    if (area > 1e-12 * longest) {
      f.normal = normal / area;
      f.distance = f.normal.dot((a + b + c) / 3);
    } else {  // a sliver, which is never the nearest face
      f.normal = Vec3::Zero();
      f.distance = std::numeric_limits<double>::infinity();
    }
  }

  /// Replaces the visible faces by a fan from the tip to their rim.
  bool replace_visible(int tip) {
    std::array<Edge, max_corners> rim;
    std::array<int, max_corners> leaving;  // edge of the rim that leaves each corner
    leaving.fill(-1);
    int edges = 0;
    for (int i = 0; i < visible_count_; ++i) {
      const Face& f = at(visible_[std::size_t(i)]);
      for (int k = 0; k < 3; ++k) {
        if (at(f.neighbours[k]).is_visible) continue;
        const int from = f.corners[k];
        if (edges == max_corners || leaving[std::size_t(from)] >= 0) return false;
        leaving[std::size_t(from)] = edges;
        rim[std::size_t(edges++)] = {from, f.corners[(k + 1) % 3], f.neighbours[k]};
      }
    }
    if (edges < 3 || face_count_ - free_count_ - visible_count_ + edges > max_faces) return false;
    for (int i = 0; i < visible_count_; ++i) {
      at(visible_[std::size_t(i)]).is_alive = false;
      free_[std::size_t(free_count_++)] = visible_[std::size_t(i)];
    }
    std::array<int, max_corners> number;
    for (int e = 0; e < edges; ++e)
      number[std::size_t(e)] = free_count_ > 0 ? free_[std::size_t(--free_count_)] : face_count_++;
    int walked = 0;
    for (int e = 0; walked < edges; ++walked) {
      const Edge& edge = rim[std::size_t(e)];
      const int after = leaving[std::size_t(edge.to)];
      if (after < 0 || (after == 0) != (walked + 1 == edges)) return false;  // the rim is not one loop
      at(number[std::size_t(after)]).neighbours[2] = number[std::size_t(e)];
      e = after;
    }
    for (int e = 0; e < edges; ++e) {
      const Edge& edge = rim[std::size_t(e)];
      const int self = number[std::size_t(e)];
      set_face(self, {edge.from, edge.to, tip},
               {edge.beyond, number[std::size_t(leaving[std::size_t(edge.to)])], at(self).neighbours[2]});
      Face& beyond = at(edge.beyond);
      for (int k = 0; k < 3; ++k)
        if (beyond.corners[k] == edge.to) beyond.neighbours[k] = self;
    }
    return true;
  }

  std::array<Vec3, max_corners> corners_;
  std::array<Face, max_faces> faces_;
  std::array<int, max_faces> visible_, free_;
  int corner_count_ = 0, face_count_ = 0, visible_count_ = 0, free_count_ = 0;
};

/// Searches the direction in which the difference reaches least far.
class LeastReach {
 public:
  explicit LeastReach(const CorePair& pair) : pair_(pair) {}

  Penetration find() {
    Vec3 corners[4];
    if (!choose_corners(corners)) return best_;
    Polytope polytope;
    if (!polytope.start(corners)) return best_;
    const double tolerance = 1e-8 * (corners[1] - corners[0]).norm();
    while (best_.depth > 0) {
      const int nearest = polytope.nearest_face();
      if (nearest < 0) break;
      const Polytope::Face& face = polytope.face(nearest);
      if (best_.depth - face.distance <= tolerance) break;
      const Vec3 point = reach(face.normal);
      if (face.normal.dot(point) - face.distance <= tolerance) break;
      if (!polytope.expand(nearest, point)) break;
    }
    return best_;
  }

 private:
  /// Returns the farthest point along a unit vector, and keeps the direction if it is the best so far.
  Vec3 reach(const Vec3& n) {
    const Vec3 point = pair_.support(n);
    if (const double depth = n.dot(point); depth < best_.depth) best_ = {depth, n};
    return point;
  }

  /// Chooses four far points of the difference. Returns false if it is flat, or does not hold the origin.
  bool choose_corners(Vec3 (&p)[4]) {
    const double length = pair_.offset.norm();
    const Vec3 away = length > 0 ? Vec3(pair_.offset / -length) : Vec3(Vec3::UnitX());
    p[0] = reach(away);
    p[1] = reach(-away);
    const Vec3 line = p[1] - p[0];
    if (!(line.squaredNorm() > 0)) return false;
    const Vec3 aside = perpendicular(line.normalized());
    p[2] = farther(reach(aside), reach(-aside), [&](const Vec3& q) { return line.cross(q - p[0]).squaredNorm(); });
    const Vec3 across = line.cross(p[2] - p[0]);
    if (!(across.squaredNorm() > 0)) return false;
    const Vec3 up = across.normalized();
    p[3] = farther(reach(up), reach(-up), [&](const Vec3& q) { return std::abs(up.dot(q - p[0])); });
    return best_.depth > 0;
  }
  template <class Measure>
  static Vec3 farther(const Vec3& a, const Vec3& b, Measure measure) {
    return measure(a) >= measure(b) ? a : b;
  }

  const CorePair& pair_;
  Penetration best_{std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
};

}  // namespace

Penetration least_translation(const CorePair& pair) {
  const Separation cores = separation(pair);
  if (cores.relation == Relation::apart) return {0, Vec3::UnitZ()};
  if (cores.relation == Relation::near)
    return {pair.ball + cores.direction.dot(pair.support(cores.direction)), cores.direction};
  Penetration penetration = LeastReach(pair).find();
  penetration.depth += pair.ball;
  return penetration;
}

}  // namespace muro::native
