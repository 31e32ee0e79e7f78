// SPDX-License-Identifier: MIT
#include "terrain/ridges.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace muro::native {
namespace {

/// Largest sine of the angle between triangles that count as one plane; heights are numbers of 24 bits.
constexpr double least_fold = 1e-4;

/// Lower side of a solid seen along an edge, and how far to the left of the edge it is.
class EdgeView {
 public:
  EdgeView(const Solid& solid, const Vec3& on_edge, const Vec3& along)
      : solid_(solid), on_edge_(on_edge), along_(along) {}

  struct Lowest {
    Vec3 normal, point;  ///< `point` of the core is lowest along `normal`
    double aside;        ///< m, across the normal
  };
  Lowest along(const Vec3& normal) const { return along(Side{normal, solid_.core.support(-normal)}); }
  Lowest along(const Side& side) const { return {side.normal, side.lowest, aside(side.normal, side.lowest)}; }
  double depth(const Lowest& l) const { return l.normal.dot(on_edge_ - l.point) + solid_.core.ball; }

  /// Returns the lowest point just over the edge, where the lowest points change sides between two normals.
  std::optional<Lowest> between(Lowest left, Lowest right) const {
    if (!(left.aside < 0 && right.aside > 0)) return {};
    if (solid_.core.kind == ConvexCore::Kind::point) return of_point();
    const double rounding = 1e-11 * (left.point - right.point).norm();
    Vec3 normal = left.normal;
    for (int i = 0; i < 60; ++i) {
      normal = (left.point - right.point).cross(along_);  // `left.point` is on the right of the edge
      const double length = normal.norm();
      const bool is_between =
          length > 0 && normal.cross(left.normal).dot(along_) < 0 && right.normal.cross(normal).dot(along_) < 0;
      normal = is_between ? Vec3(normal / length) : Vec3((left.normal + right.normal).normalized());
      const Lowest middle = along(normal);
      const double lower = std::min(normal.dot(left.point), normal.dot(right.point)) - normal.dot(middle.point);
      const bool is_over = aside(normal, left.point) <= 0 && aside(normal, right.point) >= 0;
      if ((is_between && is_over && lower <= rounding) || (left.normal - right.normal).squaredNorm() < 1e-20) break;
      (middle.aside < 0 ? left : right) = middle;
    }
    const double at_left = aside(normal, left.point), at_right = aside(normal, right.point);
    const double part = at_right > at_left ? std::clamp(at_right / (at_right - at_left), 0.0, 1.0) : 0.5;
    return Lowest{normal, right.point + part * (left.point - right.point), 0};
  }

 private:
  double aside(const Vec3& normal, const Vec3& point) const { return (point - on_edge_).dot(normal.cross(along_)); }
  /// Returns the lowest point of a sphere.
  std::optional<Lowest> of_point() const {
    Vec3 way = solid_.core.centre - on_edge_;
    way -= way.dot(along_) * along_;
    const double length = way.norm();
    if (!(length > 0)) return {};
    return Lowest{way / length, solid_.core.centre, 0};
  }

  const Solid& solid_;
  const Vec3 on_edge_, along_;
};

}  // namespace

bool is_apart(const Solid& solid, const Vec3& from, const Vec3& to) {
  const Vec3 middle = 0.5 * (from + to) - solid.shape.centre, half = 0.5 * (to - from);
  const double ball = solid.core.ball;
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = solid.shape.axes.col(k);
    const double own =
        solid.shape.kind == ShapeKind::capsule && k == 2 ? solid.shape.half.z() + ball : solid.shape.half[k];
    if (std::abs(axis.dot(middle)) > own + std::abs(axis.dot(half))) return true;
  }
  return false;
}

void add_edge_contacts(const Solid& solid, const Edge& edge, std::vector<ContactPoint>& points) {
  // the test that most edges fail comes first
  const Vec3 way = edge.to - edge.from, fold = edge.left.normal.cross(edge.right.normal);
  if (!(fold.dot(way) > 0)) return;
  const auto is_below = [&](const Side& side) {
    return side.normal.dot(edge.from - side.lowest) + solid.core.ball > 0;
  };
  if (!is_below(edge.left) || !is_below(edge.right)) return;
  const double length = way.norm();
  const Vec3 along = way / length;
  if (fold.dot(along) < least_fold) return;
  const EdgeView view(solid, edge.from, along);
  const EdgeView::Lowest left = view.along(edge.left), right = view.along(edge.right);
  const std::optional<EdgeView::Lowest> lowest = view.between(left, right);
  if (!lowest) return;
  const Vec3& normal = lowest->normal;
  const double depth = view.depth(*lowest), size = solid.shape.half.norm();
  if (!(depth > 0)) return;
  // sides and lines of the solid that lie along the edge touch it in several points
  contact_geometry::Feature line;
  line.count = 2;
  line.points[0] = line.support = edge.from;
  line.points[1] = edge.to;
  line.centre = 0.5 * (edge.from + edge.to);
  Manifold patch;
  add_overlap(solid.feature_towards(-normal), line, normal, patch);
  const std::size_t before = points.size();
  for (int i = 0; i < patch.count; ++i)
    if (const ContactPoint& p = patch.points[i]; std::abs(p.depth - depth) < 1e-6 * size) points.push_back(p);
  if (points.size() > before) return;
  const double at = along.dot(lowest->point - edge.from), slack = 1e-9 * (length + size);
  if (at < -slack || at > length + slack) return;
  points.push_back({lowest->point + (0.5 * depth - solid.core.ball) * normal, normal, depth});
}

void add_peak_contact(const Solid& solid, const Terrain& terrain, std::uint32_t column, std::uint32_t row,
                      std::vector<ContactPoint>& points) {
  const Vec3 node = terrain.map().node(column, row);
  if (is_apart(solid, node, node)) return;
  bool is_inside = true;
  Solid::WayOut best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  solid.each_way_out(node, [&](const Solid::WayOut& way) {
    if (!(way.depth > 0)) is_inside = false;
    if (way.depth >= best.depth || way.normal.z() < 0 || !terrain.is_peak(column, row, way.normal)) return;
    best = way;
  });
  if (!is_inside || !std::isfinite(best.depth)) return;
  points.push_back({node - 0.5 * best.depth * best.normal, best.normal, best.depth});
}

}  // namespace muro::native
