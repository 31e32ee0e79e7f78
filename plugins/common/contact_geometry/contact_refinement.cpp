// SPDX-License-Identifier: MIT
#include "contact_refinement.hpp"

#include <algorithm>

#include "gradient_descent.hpp"
#include "muro/base/elementary.hpp"

namespace muro::contact_geometry {
namespace {

constexpr double cos_half_degree = 1 - 5e-5;
constexpr double same_direction = 0.99;  ///< cosine
constexpr std::size_t max_points_per_normal = 8;

bool usable(const EngineContact& t) {
  return t.depth > 0 && std::isfinite(t.depth) && t.point.allFinite() && std::abs(t.normal.squaredNorm() - 1) < 1e-3;
}

/// Returns the point moved along the normal to half way between the surfaces. Engines give a point on either surface,
/// or between them. For an exact mesh the distance is not known.
ContactPoint at_midpoint(const CollisionObject& a, const CollisionObject& b, const EngineContact& t) {
  ContactPoint best{t.point, t.normal, t.depth};
  double least = std::numeric_limits<double>::infinity();
  for (const double shift : {0.0, 0.5, -0.5}) {
    const Vec3 point = t.point + shift * t.depth * t.normal;
    double off = std::abs(signed_distance(a, point - 0.5 * t.depth * t.normal));
    if (!b.geometry->exact_mesh) off += std::abs(signed_distance(b, point + 0.5 * t.depth * t.normal));
    if (off >= least - 1e-9 * t.depth) continue;
    least = off;
    best.point = point;
  }
  return best;
}

/// Features that face each other along a normal from b to a, and the depth of the objects' overlap along it.
struct Facing {
  Feature a, b;
  double depth;

  Facing(const CollisionObject& object_a, const CollisionObject& object_b, const Vec3& normal) {
    const double reach = 2 * bounding_radius(*object_a.geometry);
    a = feature_towards(object_a, -normal, object_a.shape.centre, reach);
    b = feature_towards(object_b, normal, object_a.shape.centre, reach);
    depth = normal.dot(b.support - a.support);
  }
};

void refine_single(const CollisionObject& a, const CollisionObject& b, const EngineContact& contact,
                   std::vector<ContactPoint>& points) {
  Vec3 normal = b.geometry->is_plane() ? Vec3(b.shape.axis()) : contact.normal;
  if (contact.rough && !b.geometry->is_plane()) normal = minimum_translation_direction(a, b, normal);
  Facing facing(a, b, normal);
  for (const Vec3& face : {facing.b.normal, Vec3(-facing.a.normal)}) {
    if (face.dot(normal) < cos_half_degree) continue;
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

/// Keeps the deepest of points that are closer to each other than `distance` (m), from number `first` on.
void remove_duplicates(std::vector<ContactPoint>& points, std::size_t first, double distance) {
  std::size_t count = first;
  for (std::size_t i = first; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    std::size_t same = first;
    while (same < count && ((points[same].point - p.point).squaredNorm() > distance * distance ||
                            points[same].normal.dot(p.normal) < same_direction))
      ++same;
    if (same == count)
      points[count++] = p;
    else if (p.depth > points[same].depth)
      points[same] = p;
  }
  points.erase(points.begin() + std::ptrdiff_t(count), points.end());
}

/// Adds the support point of a feature that is a single point, if it is over or under the triangle.
void add_support_point(const Feature& point, const Feature& face, Manifold& out) {
  const double depth = face.normal.dot(face.centre - point.support);
  if (depth <= 0) return;
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = face.points[(k + 1) % 3] - face.points[k];
    const Vec3 inward = face.normal.cross(side);
    const double winding = inward.dot(face.centre - face.points[k]);  // sign: an open mesh may be seen from behind
    if (inward.dot(point.support - face.points[k]) * winding < -1e-9 * winding * winding) return;
  }
  out.add(point.support + 0.5 * depth * face.normal, face.normal, depth);
}

/// Refines a contact with a triangle. Drops points deeper than `deepest` (m), which overlap with what lies behind it.
void refine_triangle(const CollisionObject& a, const CollisionObject& b, const EngineContact& contact, double deepest,
                     std::vector<ContactPoint>& points) {
  const ExactMesh& mesh = *b.geometry->exact_mesh;
  const auto triangle = std::size_t(contact.triangle);
  const Feature face = mesh.face(triangle, b.pose, a.shape.centre);
  const double along = contact.normal.dot(face.normal);
  if (along > 0 && along < cos_half_degree && mesh.allows(triangle, b.pose.orientation.conjugate() * contact.normal)) {
    points.push_back(at_midpoint(a, b, contact));
    return;
  }
  const Feature lowest = feature_towards(a, -face.normal, b.shape.centre, 0);
  Manifold patch;
  if (lowest.count == 1)
    add_support_point(lowest, face, patch);
  else
    add_overlap(lowest, face, face.normal, patch);
  for (int i = 0; i < patch.count; ++i)
    if (patch.points[i].depth <= deepest) points.push_back(patch.points[i]);
}

}  // namespace

void keep_outermost(std::vector<ContactPoint>& points, std::size_t first) {
  for (std::size_t begin = first; begin < points.size();) {
    const Vec3 normal = points[begin].normal;
    const auto from = points.begin() + std::ptrdiff_t(begin);
    const auto end = std::partition(from, points.end(),
                                    [&](const ContactPoint& p) { return p.normal.dot(normal) >= same_direction; });
    const auto count = std::size_t(end - from);
    std::size_t kept = std::min(count, max_points_per_normal);
    if (count > max_points_per_normal) {
      std::iter_swap(from, std::max_element(from, end, [](const ContactPoint& p, const ContactPoint& q) {
                       return p.depth < q.depth;
                     }));
      const Vec3 x = perpendicular(normal), y = normal.cross(x);
      for (kept = 1; kept < max_points_per_normal; ++kept) {
        const double angle = 2 * M_PI * double(kept - 1) / double(max_points_per_normal - 1);
        const auto [sine, cosine] = elementary::sincos(angle);
        const Vec3 side = cosine * x + sine * y;
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

void refine_contacts(const CollisionObject& a, const CollisionObject& b, std::vector<EngineContact>& contacts,
                     std::vector<ContactPoint>& points) {
  std::erase_if(contacts, [](const EngineContact& t) { return !usable(t); });
  for (EngineContact& t : contacts) t.normal.normalize();
  if (contacts.empty()) return;
  const std::size_t first = points.size();
  if (!b.geometry->exact_mesh) {
    if (contacts.size() == 1 || contacts[0].rough) return refine_single(a, b, contacts[0], points);
    for (const EngineContact& t : contacts) points.push_back(at_midpoint(a, b, t));
    remove_duplicates(points, first, 1e-6 * bounding_radius(*a.geometry));
    return;
  }
  for (EngineContact& t : contacts)
    if (t.triangle < 0)
      t.triangle = b.geometry->exact_mesh->triangle_at(b.pose.inverse() * t.point,
                                                       t.depth + 1e-6 * bounding_radius(*a.geometry));
  std::sort(contacts.begin(), contacts.end(), [](const EngineContact& s, const EngineContact& t) {
    return s.triangle != t.triangle ? s.triangle < t.triangle : s.depth > t.depth;
  });
  // a slim tip on an edge has a short way out to the side of either triangle, which is no real way out
  double deepest = 1e-3 * bounding_radius(*a.geometry);
  for (const EngineContact& t : contacts) deepest = std::max(deepest, 1.5 * t.depth);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i].triangle < 0)
      points.push_back(at_midpoint(a, b, contacts[i]));
    else if (i == 0 || contacts[i].triangle != contacts[i - 1].triangle)
      refine_triangle(a, b, contacts[i], deepest, points);
  remove_duplicates(points, first, 1e-4 * bounding_radius(*a.geometry));
  keep_outermost(points, first);
}

}  // namespace muro::contact_geometry
