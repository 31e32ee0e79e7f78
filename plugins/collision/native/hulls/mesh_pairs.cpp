// SPDX-License-Identifier: MIT
#include "hulls/mesh_pairs.hpp"

#include <algorithm>

#include "hulls/expanding_polytope.hpp"
#include "hulls/triangles.hpp"
#include "plugins/common/contact_geometry/contact_refinement.hpp"

namespace muro::native {
namespace {

bool has_meshes(const Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes))
      if (s.kind == ShapeKind::mesh) return true;
  return false;
}

ConvexCore core_of(const CollisionObject& object, const HullSupport* hull) {
  return hull ? ConvexCore::of(*hull, object.pose, object.shape.centre) : ConvexCore::of(object.shape);
}

}  // namespace

void collide_geometries(const CollisionObject& a, const HullSupport* hull_a, const CollisionObject& b,
                        const HullSupport* hull_b, std::vector<ContactPoint>& points) {
  const ConvexCore core_a = core_of(a, hull_a);
  if (b.geometry->exact_mesh) {
    thread_local std::vector<EngineContact> found;
    found.clear();
    find_triangles(a, core_a, b, found);
    if (!found.empty()) refine_contacts(a, b, found, points);
    return;
  }
  const ConvexCore core_b = core_of(b, hull_b);
  const Penetration out = least_translation(CorePair(core_a, core_b));
  if (!(out.depth > 0)) return;
  Manifold patch;
  add_patch(feature_towards(a, -out.normal, b.shape.centre, 0), feature_towards(b, out.normal, a.shape.centre, 0),
            out.normal, out.depth, patch);
  points.insert(points.end(), patch.points, patch.points + patch.count);
}

void MeshPairs::connect(Connector& c, bool exact) {
  if (!has_meshes(c)) return;
  geometries_.connect(
      c, exact,
      [this](const CollisionGeometry& geometry) {
        hull_of_.push_back(geometry.hull ? &hulls_.emplace_back(*geometry.hull) : nullptr);
      },
      GeometryTable::Heightmaps::left_out);
}

void MeshPairs::start(std::span<const Collider> colliders) {
  if (any()) geometries_.start(colliders);
}

KernelShape MeshPairs::kernel_shape(std::uint32_t collider, const Shape& mesh, std::uint32_t body) {
  const GeometryTable::Numbers& numbers = geometries_.of(collider);
  KernelShape shape = kernel_shape_of(mesh, geometries_[numbers.usual].box, body);
  if (numbers.convex == GeometryTable::none) return shape;
  const mesh::Hull* const hull = geometries_[numbers.convex].hull;
  auto placed = std::find_if(placed_.begin(), placed_.end(), [&](const Placed& p) {
    return p.hull == hull && p.origin.position == mesh.origin.position &&
           p.origin.orientation.coeffs() == mesh.origin.orientation.coeffs();
  });
  if (placed == placed_.end()) {
    placed_.push_back({hull, mesh.origin, {}});
    placed = std::prev(placed_.end());
    for (const Vec3& v : hull->vertices) placed->vertices.push_back(mesh.origin * v);
  }
  shape.vertices = placed->vertices.data()->data();
  shape.vertex_count = int(placed->vertices.size());
  return shape;
}

MeshPairs::HullOf MeshPairs::hull_of(std::uint32_t collider) const {
  const std::uint32_t number = geometries_.of(collider).convex;
  if (number == GeometryTable::none) return {};
  return {&geometries_[number], hull_of_[number]};
}

void MeshPairs::collide(const TransformedCollider& first, const TransformedCollider& second,
                        std::vector<ContactPoint>& points) const {
  const TransformedCollider *a = &first, *b = &second;
  std::uint32_t number_a = GeometryTable::none, number_b = GeometryTable::none;
  geometries_.choose(*a, *b, number_a, number_b);
  if (number_a == GeometryTable::none || number_b == GeometryTable::none) return;
  const bool exchanged = geometries_.is_exact_mesh(number_a);
  if (exchanged) std::swap(a, b), std::swap(number_a, number_b);
  const CollisionObject object_a{&geometries_[number_a], a->collider->pose(), a->shape},
      object_b{&geometries_[number_b], b->collider->pose(), b->shape};
  collide_geometries(object_a, hull_of_[number_a], object_b, hull_of_[number_b], points);
  if (!exchanged) return;
  for (ContactPoint& p : points) p.normal = -p.normal;
}

}  // namespace muro::native
