// SPDX-License-Identifier: MIT
#include "resolve.hpp"

#include <algorithm>

#include "downhill.hpp"

namespace muro::encounters {
namespace {

constexpr double nearly = 1 - 5e-5;  ///< cosine: half a degree
constexpr double same_direction = 0.99;
constexpr std::size_t most_of_a_direction = 8;

bool usable(const Touch& t) {
  return t.depth > 0 && std::isfinite(t.depth) && t.point.allFinite() && std::abs(t.normal.squaredNorm() - 1) < 1e-3;
}

/// The point moved along the normal to where it is half way between the surfaces: engines give one on either, or
/// between. Of a mesh as it is nothing is known.
ContactPoint half_way(const Standing& a, const Standing& b, const Touch& t) {
  ContactPoint best{t.point, t.normal, t.depth};
  double least = std::numeric_limits<double>::infinity();
  for (const double shift : {0.0, 0.5, -0.5}) {
    const Vec3 point = t.point + shift * t.depth * t.normal;
    double off = std::abs(height_over(a, point - 0.5 * t.depth * t.normal));
    if (!b.solid->terrain) off += std::abs(height_over(b, point + 0.5 * t.depth * t.normal));
    if (off >= least - 1e-9 * t.depth) continue;
    least = off;
    best.point = point;
  }
  return best;
}

/// What looks at each other along a normal from b to a, and how deep the solids overlap along it.
struct Facing {
  Feature a, b;
  double depth;

  Facing(const Standing& on, const Standing& below, const Vec3& normal) {
    const double reach = 2 * reach_of(*on.solid);
    a = feature_towards(on, -normal, on.placed.centre, reach);
    b = feature_towards(below, normal, on.placed.centre, reach);
    depth = normal.dot(b.tip - a.tip);
  }
};

void resolve_single(const Standing& a, const Standing& b, const Touch& touch, std::vector<ContactPoint>& points) {
  Vec3 normal = b.solid->is_plane() ? Vec3(b.placed.axis()) : touch.normal;
  if (touch.rough && !b.solid->is_plane()) normal = least_direction(a, b, normal);
  Facing facing(a, b, normal);
  for (const Vec3& face : {facing.b.normal, Vec3(-facing.a.normal)}) {
    if (face.dot(normal) < nearly) continue;
    const Facing flat(a, b, face);
    if (flat.depth > facing.depth * 1.001) continue;
    facing = flat;
    normal = face;
    break;
  }
  if (!(facing.depth > 0)) return;
  Manifold patch;
  add_patch(facing.a, facing.b, normal, facing.depth, patch);
  points.insert(points.end(), patch.points, patch.points + patch.count);
}

/// Keeps the deepest of points that are nearer to each other than `distance`, from number `first` on.
void drop_doubles(std::vector<ContactPoint>& points, std::size_t first, double distance) {
  std::size_t kept = first;
  for (std::size_t i = first; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    std::size_t same = first;
    while (same < kept && ((points[same].point - p.point).squaredNorm() > distance * distance ||
                           points[same].normal.dot(p.normal) < same_direction))
      ++same;
    if (same == kept)
      points[kept++] = p;
    else if (p.depth > points[same].depth)
      points[same] = p;
  }
  points.erase(points.begin() + std::ptrdiff_t(kept), points.end());
}

/// Of points with one normal keeps the deepest and the outermost to seven sides.
void thin_out(std::vector<ContactPoint>& points, std::size_t first) {
  for (std::size_t begin = first; begin < points.size();) {
    const Vec3 normal = points[begin].normal;
    const auto from = points.begin() + std::ptrdiff_t(begin);
    const auto end = std::partition(from, points.end(),
                                    [&](const ContactPoint& p) { return p.normal.dot(normal) >= same_direction; });
    const auto count = std::size_t(end - from);
    std::size_t kept = std::min(count, most_of_a_direction);
    if (count > most_of_a_direction) {
      std::iter_swap(from, std::max_element(from, end, [](const ContactPoint& p, const ContactPoint& q) {
                       return p.depth < q.depth;
                     }));
      const Vec3 x = perpendicular(normal), y = normal.cross(x);
      for (kept = 1; kept < most_of_a_direction; ++kept) {
        const double angle = 2 * M_PI * double(kept - 1) / double(most_of_a_direction - 1);
        const Vec3 side = std::cos(angle) * x + std::sin(angle) * y;
        const auto rest = from + std::ptrdiff_t(kept);
        std::iter_swap(rest, std::max_element(rest, end, [&](const ContactPoint& p, const ContactPoint& q) {
                         return p.point.dot(side) < q.point.dot(side);
                       }));
      }
    }
    points.erase(from + std::ptrdiff_t(kept), end);
    begin += kept;
  }
}

/// The lowest point of a solid that ends in one, when it is over (or under) the triangle.
void add_tip(const Feature& tip, const Feature& face, Manifold& out) {
  const double depth = face.normal.dot(face.centre - tip.tip);
  if (depth <= 0) return;
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = face.points[(k + 1) % 3] - face.points[k];
    const Vec3 inward = face.normal.cross(side);
    const double winding = inward.dot(face.centre - face.points[k]);  // of an open mesh seen from behind
    if (inward.dot(tip.tip - face.points[k]) * winding < -1e-9 * winding * winding) return;
  }
  out.add(tip.tip + 0.5 * depth * face.normal, face.normal, depth);
}

/// A point deeper than `deepest` (m) overlaps with what lies behind the triangle, not with it.
void resolve_triangle(const Standing& a, const Standing& b, const Touch& touch, double deepest,
                      std::vector<ContactPoint>& points) {
  const Terrain& terrain = *b.solid->terrain;
  const auto triangle = std::size_t(touch.triangle);
  const Feature face = terrain.face(triangle, b.pose, a.placed.centre);
  const double along = touch.normal.dot(face.normal);
  if (along > 0 && along < nearly && terrain.allows(triangle, b.pose.orientation.conjugate() * touch.normal)) {
    points.push_back(half_way(a, b, touch));
    return;
  }
  const Feature lowest = feature_towards(a, -face.normal, b.placed.centre, 0);
  Manifold patch;
  if (lowest.count == 1)
    add_tip(lowest, face, patch);
  else
    add_overlap(lowest, face, face.normal, patch);
  for (int i = 0; i < patch.count; ++i)
    if (patch.points[i].depth <= deepest) points.push_back(patch.points[i]);
}

}  // namespace

void resolve(const Standing& a, const Standing& b, std::vector<Touch>& touches, std::vector<ContactPoint>& points) {
  std::erase_if(touches, [](const Touch& t) { return !usable(t); });
  for (Touch& t : touches) t.normal.normalize();
  if (touches.empty()) return;
  const std::size_t first = points.size();
  if (!b.solid->terrain) {
    if (touches.size() == 1 || touches[0].rough) return resolve_single(a, b, touches[0], points);
    for (const Touch& t : touches) points.push_back(half_way(a, b, t));
    drop_doubles(points, first, 1e-6 * reach_of(*a.solid));
    return;
  }
  for (Touch& t : touches)
    if (t.triangle < 0)
      t.triangle = b.solid->terrain->triangle_at(b.pose.inverse() * t.point, t.depth + 1e-6 * reach_of(*a.solid));
  std::sort(touches.begin(), touches.end(), [](const Touch& s, const Touch& t) {
    return s.triangle != t.triangle ? s.triangle < t.triangle : s.depth > t.depth;
  });
  double deepest = 0;
  for (const Touch& t : touches) deepest = std::max(deepest, t.depth);
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (touches[i].triangle < 0)
      points.push_back(half_way(a, b, touches[i]));
    else if (i == 0 || touches[i].triangle != touches[i - 1].triangle)
      resolve_triangle(a, b, touches[i], 1.5 * deepest, points);
  drop_doubles(points, first, 1e-4 * reach_of(*a.solid));
  thin_out(points, first);
}

}  // namespace muro::encounters
