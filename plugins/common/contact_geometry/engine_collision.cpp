// SPDX-License-Identifier: MIT
#include "engine_collision.hpp"

#include "contact_refinement.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::contact_geometry {
namespace {

bool is_plane(const TransformedCollider& c) { return c.shape.kind == ShapeKind::plane; }

/// Whether the whole box is on the free side of the plane.
bool is_clear(const Aabb& box, const TransformedShape& plane) {
  const Vec3 n = plane.axis(), half = 0.5 * (box.high - box.low);
  return n.dot(0.5 * (box.low + box.high) - plane.centre) > n.cwiseAbs().dot(half);
}

}  // namespace

/// Buffers of one thread.
struct EngineCollision::Scratch {
  std::unique_ptr<NarrowPhase> narrow_phase;
  std::vector<EngineContact> contacts;
};

EngineCollision::EngineCollision(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

EngineCollision::~EngineCollision() = default;

void EngineCollision::connect(Connector& c) {
  PairCollision::connect(c);
  if (!is_needed()) return;
  engine_->use_log(c.host());
  const bool as_meshes = engine_->takes_heightmaps_as_meshes();
  geometries_.connect(
      c, c.parameters().text("meshes") == "exact",
      [this](const CollisionGeometry& geometry) { engine_->add(geometry); },
      as_meshes ? GeometryTable::Heightmaps::as_meshes : GeometryTable::Heightmaps::left_out);
  if (!as_meshes) heightmaps_.load(c);
  names_.resize(c.object_count());
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    if (!c.constant_array(ObjectId{i}, keys::collision_shapes).empty()) names_[i] = c.object_name(ObjectId{i});
}

void EngineCollision::start() {
  if (!is_needed()) return;
  geometries_.start(index_->colliders);
  PairCollision::start();
}

/// Returns the shape of a collider. A heightmap that the engine does not take has the box of its solid.
TransformedShape EngineCollision::transformed_shape(std::uint32_t collider) const {
  const Collider& c = index_->colliders[collider];
  if (c.shape->kind == ShapeKind::heightmap && !heightmaps_.empty()) {
    Aabb box = heightmap::bounds_of(heightmaps_.of(*c.shape));
    box.low.z() -= heightmap::depth_of_ground;
    TransformedShape shape =
        transformed(Shape::box(box.high - box.low), c.pose() * Pose{0.5 * (box.low + box.high), Quat::Identity()});
    shape.kind = ShapeKind::heightmap;
    return shape;
  }
  return collision_object(geometries_[geometries_.of(collider).usual], index_->colliders[collider].pose()).shape;
}

void EngineCollision::ask_engine(const TransformedCollider& a, std::uint32_t number_a, const TransformedCollider& b,
                                 std::uint32_t number_b, Scratch& scratch) const {
  try {
    scratch.narrow_phase->collide(number_a, a.collider->pose(), number_b, b.collider->pose(), scratch.contacts);
  } catch (const std::exception& failure) {
    throw Error(quote(names_[index_of(a.collider->body)]) + " and " + quote(names_[index_of(b.collider->body)]) +
                ": the engine cannot tell whether they touch: " + failure.what() +
                "; look at their sizes and poses, or use collision.native");
  }
}

void EngineCollision::collide_with_terrain(const TransformedCollider& a, const TransformedCollider& terrain,
                                           std::vector<ContactPoint>& points) const {
  const Shape& shape = *a.collider->shape;
  const GeometryTable::Numbers& numbers = geometries_.of(a.number);
  const mesh::Hull* const hull = shape.kind == ShapeKind::mesh && numbers.convex != GeometryTable::none
                                     ? geometries_[numbers.convex].hull
                                     : nullptr;
  terrain_contact::TerrainContacts found;
  const int count = terrain_contact::find_contacts(heightmaps_.of(*terrain.collider->shape), terrain.collider->pose(),
                                                   {shape.kind, shape.size, hull, a.collider->pose()}, 0, found);
  for (int i = 0; i < count; ++i) {
    const terrain_contact::TerrainContact& c = found[std::size_t(i)];
    if (c.gap < 0) points.push_back({c.position, c.normal, -c.gap});
  }
}

void EngineCollision::collide(const TransformedCollider& first, const TransformedCollider& second,
                              std::vector<ContactPoint>& points) {
  if (is_plane(second) ? is_clear(first.bounds, second.shape) : is_plane(first) && is_clear(second.bounds, first.shape))
    return;
  if (second.shape.kind == ShapeKind::heightmap) return collide_with_terrain(first, second, points);
  const TransformedCollider *a = &first, *b = &second;
  std::uint32_t number_a = GeometryTable::none, number_b = GeometryTable::none;
  geometries_.choose(*a, *b, number_a, number_b);
  if (number_a == GeometryTable::none || number_b == GeometryTable::none) return;
  // Only the second may be a plane or an exact mesh.
  const bool exchanged = geometries_.is_exact_mesh(number_a) || is_plane(*a);
  if (exchanged) std::swap(a, b), std::swap(number_a, number_b);
  Scratch& scratch = scratch_.local([this] {
    return std::make_unique<Scratch>(Scratch{.narrow_phase = engine_->make_narrow_phase(), .contacts = {}});
  });
  scratch.contacts.clear();
  const CollisionObject object_a{&geometries_[number_a], a->collider->pose(), a->shape},
      object_b{&geometries_[number_b], b->collider->pose(), b->shape};
  ask_engine(*a, number_a, *b, number_b, scratch);
  if (scratch.contacts.empty()) return;
  refine_contacts(object_a, object_b, scratch.contacts, points);
  if (!exchanged) return;
  for (ContactPoint& p : points) p.normal = -p.normal;
}

}  // namespace muro::contact_geometry
