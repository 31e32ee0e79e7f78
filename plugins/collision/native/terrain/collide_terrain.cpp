// SPDX-License-Identifier: MIT
#include "terrain/collide_terrain.hpp"

#include <algorithm>
#include <limits>

#include "lanes/ground.hpp"
#include "lanes/plane_points.hpp"
#include "lanes/terrain_points.hpp"
#include "pairs/kernel_view.hpp"
#include "plugins/common/contact_geometry/contact_refinement.hpp"
#include "terrain/ridges.hpp"

namespace muro::native {
namespace {

constexpr double same_direction = 0.99;  ///< cosine
/// Sine of the angle to a triangle below which a cylinder is upright on it; heights are numbers of 24 bits.
constexpr double least_tilt = 2e-5;
using Cell = Heightmap::Cell;

Vec3 vector_of(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }

/// Finds the points of one solid, in the frame of the heightmap.
class TerrainContacts {
 public:
  TerrainContacts(const Solid& solid, const Terrain& terrain, std::vector<ContactPoint>& points)
      : solid_(solid), terrain_(terrain), sides_(solid, terrain), points_(points), first_(points.size()) {
    points.reserve(first_ + max_points + Manifold::capacity);
  }

  void find() {
    Aabb box = bounds_of(solid_.shape);
    // a point deep below a slope is nearest to a triangle beside it
    const double beside = 0.3 * solid_.shape.half.norm();
    box.low -= Vec3(beside, beside, 0), box.high += Vec3(beside, beside, 0);
    if (solid_.hull)
      for (const Vec3& v : solid_.hull->hull->vertices) add_vertex(solid_.pose * v);
    else if (solid_.shape.kind == ShapeKind::box)
      add_corners();
    else
      add_round_points(box);
    const bool is_ball = solid_.shape.kind == ShapeKind::sphere;
    terrain_.each_cell(box, [&](Cell c) {
      if (is_above(c, box)) return;
      const auto side_of = [&](Cell cell, bool upper) -> const Side& { return sides_.of(cell, upper); };
      const auto beyond = [&](const Vec3& normal) { return sides_.along(normal); };
      const auto is_near = [&](const Vec3& from, const Vec3& to) {
        return std::max(from.z(), to.z()) > box.low.z() && !is_apart(solid_, from, to);
      };
      terrain_.each_edge(c, is_near, side_of, beyond,
                         [&](const Vec3& from, const Vec3& to, const Side& left, const Side& right) {
                           const std::size_t before = points_.size();
                           add_edge_contacts(solid_, {from, to, left, right}, points_);
                           if (points_.size() == before) return;
                           is_ball ? add_only_deepest(before) : limit();
                         });
      for (const std::uint32_t column : {c.column, c.column + 1})
        for (const std::uint32_t row : {c.row, c.row + 1}) {
          if ((column > c.column && c.column + 2 < terrain_.map().columns) ||
              (row > c.row && c.row + 2 < terrain_.map().rows))
            continue;  // the node belongs to another cell
          const std::size_t before = points_.size();
          add_peak_contact(solid_, terrain_, column, row, points_);
          if (points_.size() == before) continue;
          is_ball ? add_only_deepest(before) : limit();
        }
    });
    if (points_.size() == first_) add_deep_points();
    reduce();
  }

 private:
  /// The contact of one feature of the solid with triangles of nearly one normal: the deepest one.
  struct Numbered {
    int number;
    std::size_t at;  ///< index in the points
  };

  void add_vertex(const Vec3& v) {
    const auto ground = terrain_.map().ground_at(v.x(), v.y());
    if (!ground) return;
    const double depth = (ground->height - v.z()) * ground->normal.z();
    if (!(depth > 0)) return;
    points_.push_back({v + 0.5 * depth * ground->normal, ground->normal, depth});
    limit();
  }
  void add_corners() {
    const TransformedShape& s = solid_.shape;
    for (int k = 0; k < 8; ++k)
      add_vertex(s.centre + s.axes * Vec3((k & 1 ? 1 : -1) * s.half.x(), (k & 2 ? 1 : -1) * s.half.y(),
                                          (k & 4 ? 1 : -1) * s.half.z()));
  }

  /// Adds the lowest points of a round solid relative to the plane of each triangle, where they are over the triangle.
  void add_round_points(const Aabb& box) {
    const double slack = 2e-4 * solid_.shape.half.norm();
    numbered_count_ = 0;
    terrain_.each_cell(box, [&](Cell c) {
      if (is_above(c, box)) return;
      for (const bool upper : {false, true}) {
        const Heightmap::Triangle t = terrain_.map().triangle(c, upper);
        if (std::max({t[0].z(), t[1].z(), t[2].z()}) < box.low.z()) continue;
        each_plane_point(t[0], sides_.of(c, upper).normal, [&](const ContactPoint& p, int number) {
          if (covers(t, p.point + 0.5 * p.depth * p.normal, slack)) add_numbered(p, number);
        });
      }
    });
  }
  /// Calls `sink(point, number)` for the points of a round solid below a plane.
  template <class Sink>
  void each_plane_point(const Vec3& origin, const Vec3& normal, Sink sink) const {
    GroundPlane plane;
    Vec3::Map(plane.normal) = normal;
    Vec3::Map(plane.origin) = origin;
    plane.is_level = false;
    const KernelView view{solid_.shape};
    const auto give = [&](bool below, const lane::V3<double>& point, double depth, int number) {
      if (below) sink(ContactPoint{vector_of(point), normal, depth}, number);
    };
    lanes::give_plane_points<double>(view, plane, give, least_tilt);
  }
  /// Whether a point is over or under a triangle, or at most `slack` (m) beside it.
  static bool covers(const Heightmap::Triangle& t, const Vec3& p, double slack) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = t[k], &b = t[(k + 1) % 3];
      const double x = b.x() - a.x(), y = b.y() - a.y();
      if (x * (p.y() - a.y()) - y * (p.x() - a.x()) < -slack * (std::abs(x) + std::abs(y))) return false;
    }
    return true;
  }
  void add_numbered(const ContactPoint& p, int number) {
    for (int i = 0; i < numbered_count_; ++i) {
      if (numbered_[i].number != number) continue;
      ContactPoint& known = points_[numbered_[i].at];
      if (known.normal.dot(p.normal) < same_direction) continue;
      if (p.depth > known.depth) known = p;
      return;
    }
    if (numbered_count_ == max_numbered) return;
    numbered_[numbered_count_++] = {number, points_.size()};
    points_.push_back(p);
  }
  /// Removes the points of a ball from `before` on. Adds the last one again unless a deeper one has nearly its normal.
  void add_only_deepest(std::size_t before) {
    const ContactPoint p = points_.back();
    points_.resize(before);
    add_numbered(p, 0);
  }

  /// Pushes a solid that is in the ground up, as from the plane of the triangle above its centre.
  void add_deep_points() {
    const Vec3& centre = solid_.shape.centre;
    const auto ground = terrain_.map().ground_at(centre.x(), centre.y());
    if (!ground || centre.z() >= ground->height || solid_.hull || solid_.shape.kind == ShapeKind::box) return;
    each_plane_point({centre.x(), centre.y(), ground->height}, ground->normal,
                     [&](const ContactPoint& p, int) { points_.push_back(p); });
  }

  /// Whether the cell lies below a box.
  bool is_above(Cell c, const Aabb& box) const {
    const Heightmap& m = terrain_.map();
    const double low = box.low.z();
    return m.node(c.column, c.row).z() < low && m.node(c.column + 1, c.row).z() < low &&
           m.node(c.column, c.row + 1).z() < low && m.node(c.column + 1, c.row + 1).z() < low;
  }

  /// Must be called after points have been added that `numbered_` does not know.
  void limit() {
    if (points_.size() - first_ >= max_points) reduce();
  }
  void reduce() {
    remove_duplicates();
    keep_outermost(points_, first_);
    keep_few();
  }

  /// Keeps only the deepest of the points at one place.
  void remove_duplicates() {
    const double distance = 1e-4 * solid_.shape.half.norm();
    std::size_t count = first_;
    for (std::size_t i = first_; i < points_.size(); ++i) {
      std::size_t same = first_;
      while (same < count && ((points_[same].point - points_[i].point).squaredNorm() > distance * distance ||
                              points_[same].normal.dot(points_[i].normal) < same_direction))
        ++same;
      if (same == count)
        points_[count++] = points_[i];
      else if (points_[i].depth > points_[same].depth)
        points_[same] = points_[i];
    }
    points_.resize(count);
  }

  /// Keeps no more points than a shape has on a plane: the deepest, then repeatedly the one farthest from those kept.
  void keep_few() {
    if (points_.size() - first_ <= max_ground_points) return;
    const auto first = points_.begin() + std::ptrdiff_t(first_), end = first + max_ground_points;
    std::iter_swap(first, std::max_element(first, points_.end(), [](const ContactPoint& a, const ContactPoint& b) {
                     return a.depth < b.depth;
                   }));
    for (auto next = first + 1; next != end; ++next) {
      const auto distance = [&](const ContactPoint& p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (auto kept = first; kept != next; ++kept)
          nearest = std::min(nearest, (p.point - kept->point).squaredNorm() / solid_.shape.half.squaredNorm() +
                                          (p.normal - kept->normal).squaredNorm());
        return nearest;
      };
      std::iter_swap(next, std::max_element(next, points_.end(), [&](const ContactPoint& a, const ContactPoint& b) {
                       return distance(a) < distance(b);
                     }));
    }
    points_.resize(first_ + max_ground_points);
  }

  static constexpr int max_numbered = 64;
  static constexpr std::size_t max_points = 2 * max_numbered;  ///< when so many are found, some are removed
  const Solid& solid_;
  const Terrain& terrain_;
  Sides sides_;
  std::vector<ContactPoint>& points_;
  const std::size_t first_;
  Numbered numbered_[max_numbered];
  int numbered_count_ = 0;
};

/// Adds the points that a few operations find. Returns false, and adds none, if these may not be all.
bool add_simple_points(const TransformedShape& shape, const Terrain& terrain, std::vector<ContactPoint>& points) {
  const std::size_t first = points.size();
  const KernelView view{shape};
  const auto add = [&](bool, const lane::V3<double>& point, const lane::V3<double>& normal, double depth, int) {
    points.push_back({vector_of(point), vector_of(normal), depth});
  };
  if (!lanes::give_terrain_points<double>(view, terrain.grid(), add)) return true;
  points.resize(first);
  return false;
}

void add_all_points(const Solid& solid, const Terrain& terrain, std::vector<ContactPoint>& points) {
  const std::size_t first = points.size();
  TerrainContacts(solid, terrain, points).find();
  for (std::size_t i = first; i < points.size(); ++i) {
    points[i].point = terrain.pose() * points[i].point;
    points[i].normal = terrain.pose().orientation * points[i].normal;
  }
}

}  // namespace

void collide_terrain(const TransformedShape& shape, const Terrain& terrain, std::vector<ContactPoint>& points,
                     bool is_left) {
  if (is_left || !add_simple_points(shape, terrain, points))
    add_all_points(Solid(shape, terrain.pose()), terrain, points);
}

void collide_terrain(const TransformedShape& box, const CollisionGeometry& hull, const HullSupport& support,
                     const Pose& pose, const Terrain& terrain, std::vector<ContactPoint>& points, bool is_left) {
  if (is_left || !add_simple_points(box, terrain, points))
    add_all_points(Solid(box, hull, support, pose, terrain.pose()), terrain, points);
}

}  // namespace muro::native
