// SPDX-License-Identifier: MIT
#include "hulls/triangles.hpp"

#include "hulls/expanding_polytope.hpp"
#include "pairs/gjk.hpp"

namespace muro::native {
namespace {

/// Returns the bounds of a shape in the frame of a mesh.
Aabb bounds_in(const Pose& frame, const TransformedShape& shape) {
  const Mat3 turn = frame.orientation.toRotationMatrix().transpose();
  TransformedShape local = shape;
  local.centre = turn * (shape.centre - frame.position);
  local.axes = turn * shape.axes;
  return bounds_of(local);
}

/// Returns the corner, edge or face of a triangle that lies farthest along `n`.
contact_geometry::Feature triangle_feature(const Vec3 (&corners)[3], const Vec3& n, const Vec3& normal) {
  const double size = (corners[1] - corners[0]).norm() + (corners[2] - corners[0]).norm();
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& c : corners) farthest = std::max(farthest, n.dot(c));
  contact_geometry::Feature f;
  for (const Vec3& c : corners)
    if (n.dot(c) > farthest - 1e-7 * size) f.points[f.count++] = c;
  f.support = f.points[0];
  f.is_unique = f.count == 1;
  for (int k = 0; k < f.count; ++k) f.centre += f.points[k] / f.count;
  if (f.count == 3) {
    f.count = 4;
    f.points[3] = 0.5 * (f.points[0] + f.points[2]);
    f.normal = normal.dot(n) < 0 ? Vec3(-normal) : normal;
  }
  return f;
}

/// Separates a segment, or a point, from a triangle that it crosses. Tries the face normals of the prism that both
/// sweep out.
Penetration flat_translation(const CorePair& pair, const Vec3& normal) {
  const ConvexCore &core = pair.first, &triangle = pair.second;
  Penetration best{std::numeric_limits<double>::infinity(), normal};
  const auto consider = [&](const Vec3& n) {
    const double depth = n.dot(pair.support(n));
    if (depth < best.depth - 1e-12) best = {depth, n};
  };
  consider(normal);
  consider(-normal);
  for (int k = 0; core.kind == ConvexCore::Kind::segment && k < 3; ++k) {
    const Vec3 edge = triangle.corners[(k + 1) % 3] - triangle.corners[k], across = edge.cross(core.axes.col(2));
    if (!(across.squaredNorm() > 1e-12 * edge.squaredNorm())) continue;
    consider(across.normalized());
    consider(-across.normalized());
  }
  best.depth += pair.ball;
  return best;
}

Penetration translation_of(const CorePair& pair, const Vec3& normal) {
  if (pair.first.has_volume()) return least_translation(pair);
  const Separation cores = separation(pair);
  if (cores.relation == Relation::apart) return {0, normal};
  if (cores.relation == Relation::inside) return flat_translation(pair, normal);
  return {pair.ball + cores.direction.dot(pair.support(cores.direction)), cores.direction};
}

}  // namespace

void find_triangles(const CollisionObject& shape, const ConvexCore& core, const CollisionObject& mesh,
                    std::vector<EngineContact>& found) {
  const ExactMesh& surface = *mesh.geometry->exact_mesh;
  const Pose& at = mesh.pose;
  surface.each_near(bounds_in(at, shape.shape), [&](std::uint32_t number) {
    const mesh::Triangle& t = surface.surface().triangles[number];
    Vec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k) corners[k] = at * surface.surface().vertices[t[k]];
    Vec3 normal = at.orientation * surface.normal(number);
    const double height = normal.dot(corners[0]);
    if (normal.dot(core.support(-normal)) - core.ball >= height) return;
    if (normal.dot(core.support(normal)) + core.ball <= height) return;
    if (!surface.closed() && normal.dot(shape.shape.centre) < height) normal = -normal;
    const ConvexCore triangle = ConvexCore::triangle(corners[0], corners[1], corners[2]);
    const Penetration out = translation_of(CorePair(core, triangle), normal);
    if (!(out.depth > 0)) return;
    Manifold patch;
    add_patch(feature_towards(shape, -out.normal, mesh.shape.centre, 0), triangle_feature(corners, out.normal, normal),
              out.normal, out.depth, patch);
    const ContactPoint* deepest = &patch.points[0];
    for (int i = 1; i < patch.count; ++i)
      if (patch.points[i].depth > deepest->depth) deepest = &patch.points[i];
    found.push_back({.point = deepest->point, .normal = out.normal, .depth = out.depth, .triangle = number});
  });
}

}  // namespace muro::native
