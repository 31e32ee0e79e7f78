// SPDX-License-Identifier: MIT
#include "engine_collision.hpp"

#include <algorithm>

#include "contact_refinement.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::contact_geometry {
namespace {

/// Whether two shapes collide alike, apart from their poses.
bool same_geometry(const Shape& a, const Shape& b) { return a.kind == b.kind && a.mesh == b.mesh && a.size == b.size; }

bool is_plane(const TransformedCollider& c) { return c.shape.kind == ShapeKind::plane; }

/// Whether all of the box is on the free side of the plane.
bool is_clear(const Aabb& box, const TransformedShape& plane) {
  const Vec3 n = plane.axis(), half = 0.5 * (box.high - box.low);
  return n.dot(0.5 * (box.low + box.high) - plane.centre) > n.cwiseAbs().dot(half);
}

}  // namespace

/// What one thread works with.
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
  const bool exact = c.parameters().text("meshes") == "exact";
  names_.resize(c.object_count());
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) {
      names_[i] = c.object_name(ObjectId{i});
      add_geometries(c, ObjectId{i}, s, exact);
    }
  std::sort(by_shape_.begin(), by_shape_.end(),
            [](const auto& a, const auto& b) { return std::less<>()(a.first, b.first); });
}

std::uint32_t EngineCollision::add_geometry(const CollisionGeometry& geometry) {
  geometries_.push_back(geometry);
  engine_->add(geometries_.back());
  return std::uint32_t(geometries_.size() - 1);
}

/// Null when the mesh is flat.
const mesh::Hull* EngineCollision::hull_if_any(const std::string& path, const Vec3& scale) {
  try {
    return &meshes_.hull(path, scale);
  } catch (const Error&) {
    return nullptr;
  }
}

void EngineCollision::add_mesh(const std::string& path, const Shape& shape, bool exact, GeometryNumbers& numbers) {
  const mesh::Mesh& surface = meshes_.mesh(path, shape.size);
  CollisionGeometry geometry{.shape = shape, .box = mesh::bounds_of(surface)};
  if (exact) {
    geometry.exact_mesh = &exact_meshes_.emplace_back(surface);
    numbers.usual = add_geometry(geometry);
    geometry.exact_mesh = nullptr;
    geometry.hull = hull_if_any(path, shape.size);
  } else {
    geometry.hull = &meshes_.hull(path, shape.size);
  }
  if (geometry.hull) numbers.convex = add_geometry(geometry);
}

void EngineCollision::add_geometries(Connector& c, ObjectId body, const Shape& shape, bool exact) {
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const auto& k) { return same_geometry(k.first, shape); });
  if (known != known_.end()) {
    by_shape_.push_back({&shape, known->second});
    return;
  }
  GeometryNumbers numbers;
  if (shape.kind == ShapeKind::mesh) {
    try {
      add_mesh(std::string(c.text(shape.mesh)), shape, exact, numbers);
    } catch (const Error& error) {
      mesh::refuse_collision_mesh(c, body, error);
    }
  } else {
    numbers.convex = add_geometry({.shape = shape, .box = {}});
  }
  if (numbers.usual == none) numbers.usual = numbers.convex;
  known_.push_back({shape, numbers});
  by_shape_.push_back({&shape, numbers});
}

void EngineCollision::start() {
  if (!is_needed()) return;
  by_collider_.clear();
  for (const Collider& c : index_->colliders) {
    const auto numbers =
        std::lower_bound(by_shape_.begin(), by_shape_.end(), c.shape,
                         [](const auto& entry, const Shape* shape) { return std::less<>()(entry.first, shape); });
    by_collider_.push_back(numbers->second);
  }
  PairCollision::start();
}

TransformedShape EngineCollision::transformed_shape(std::uint32_t collider) const {
  return collision_object(geometries_[by_collider_[collider].usual], index_->colliders[collider].pose()).shape;
}

/// Of two exact meshes that of a robot is taken as its hull; with a plane every mesh is.
void EngineCollision::choose_geometries(const TransformedCollider& a, const TransformedCollider& b,
                                        std::uint32_t& number_a, std::uint32_t& number_b) const {
  const GeometryNumbers &of_a = by_collider_[a.number], &of_b = by_collider_[b.number];
  number_a = of_a.usual, number_b = of_b.usual;
  if (is_exact_mesh(number_a) && (is_exact_mesh(number_b) || is_plane(b))) {
    number_a = of_a.convex;
    if (b.collider->robot >= 0) number_b = of_b.convex;
  } else if (is_exact_mesh(number_b) && is_plane(a)) {
    number_b = of_b.convex;
  }
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

void EngineCollision::collide(const TransformedCollider& first, const TransformedCollider& second,
                              std::vector<ContactPoint>& points) {
  if (is_plane(second) ? is_clear(first.bounds, second.shape) : is_plane(first) && is_clear(second.bounds, first.shape))
    return;
  const TransformedCollider *a = &first, *b = &second;
  std::uint32_t number_a = none, number_b = none;
  choose_geometries(*a, *b, number_a, number_b);
  if (number_a == none || number_b == none) return;
  // Only the second may be a plane or an exact mesh.
  const bool exchanged = is_exact_mesh(number_a) || is_plane(*a);
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
