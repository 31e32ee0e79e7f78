// SPDX-License-Identifier: MIT
#include "fcl_engine.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

namespace muro::fcl_collision {
namespace {

using contact_geometry::CollisionGeometry;
using contact_geometry::EngineContact;
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry convex_of(const mesh::Hull& hull) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const mesh::Hull::Face& f : hull.faces) {
    faces->push_back(int(f.count));
    for (const std::uint32_t c : hull.corners_of(f)) faces->push_back(int(c));
  }
  return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Vec3>>(hull.vertices),
                                        int(hull.faces.size()), faces);
}

Geometry hierarchy_of(const mesh::Mesh& surface) {
  std::vector<fcl::Triangle> triangles;
  for (const mesh::Triangle& t : surface.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(int(triangles.size()), int(surface.vertices.size()));
  model->addSubModel(surface.vertices, triangles);
  model->endModel();
  return model;
}

Geometry geometry_of(const CollisionGeometry& s) {
  const Vec3& size = s.shape.size;
  switch (s.shape.kind) {
    case ShapeKind::box:
      return std::make_shared<fcl::Boxd>(size);
    case ShapeKind::sphere:
      return std::make_shared<fcl::Sphered>(size.x());
    case ShapeKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(size.x(), size.z());
    case ShapeKind::capsule:
      return std::make_shared<fcl::Capsuled>(size.x(), size.z());
    case ShapeKind::plane:
      return std::make_shared<fcl::Halfspaced>(Vec3::UnitZ(), 0);
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
  return s.exact_mesh ? hierarchy_of(s.exact_mesh->surface()) : convex_of(*s.hull);
}

fcl::Transform3d transform_of(const Pose& p) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = p.orientation.toRotationMatrix();
  t.translation() = p.position;
  return t;
}

/// Most contacts that one pair may have: every triangle of a mesh has one.
constexpr std::size_t most_contacts = 1024;

/// Whether FCL has no solver of its own for the pair and asks libccd. Its portal refinement (Snethen, XenoCollide,
/// 2008) gives a way out, but not the shortest.
bool is_rough(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  const auto is = [](const fcl::CollisionGeometryd& g, fcl::NODE_TYPE type) { return g.getNodeType() == type; };
  const auto round = [&](const fcl::CollisionGeometryd& g) { return is(g, fcl::GEOM_SPHERE); };
  if (round(a)) return is(b, fcl::GEOM_CONVEX);
  if (round(b)) return is(a, fcl::GEOM_CONVEX);
  return !is(b, fcl::GEOM_HALFSPACE) && !(is(a, fcl::GEOM_BOX) && is(b, fcl::GEOM_BOX));
}

class FclNarrowPhase final : public contact_geometry::NarrowPhase {
 public:
  explicit FclNarrowPhase(const std::vector<Geometry>& geometries)
      : geometries_(geometries), request_(most_contacts, true, 1, false, true, fcl::GST_LIBCCD, 1e-9) {}

  void collide(std::uint32_t a, const Pose& at_a, std::uint32_t b, const Pose& at_b,
               std::vector<EngineContact>& contacts) override {
    result_.clear();
    fcl::collide(geometries_[a].get(), transform_of(at_a), geometries_[b].get(), transform_of(at_b), request_, result_);
    const bool is_mesh = geometries_[b]->getObjectType() == fcl::OT_BVH;
    const bool is_sphere = geometries_[a]->getNodeType() == fcl::GEOM_SPHERE;
    const bool rough = is_rough(*geometries_[a], *geometries_[b]);
    for (std::size_t i = 0; i < result_.numContacts(); ++i) {
      const fcl::Contactd& c = result_.getContact(i);
      if (!is_mesh) {
        contacts.push_back({c.pos, -c.normal, c.penetration_depth, -1, rough});
        continue;
      }
      // FCL exchanges a shape and a mesh; only this shows it
      const bool exchanged = c.o1 == geometries_[b].get();
      Vec3 normal = exchanged ? c.normal : Vec3(-c.normal);
      // for a sphere, FCL gives the depth with the wrong sign, and a normal without a defined sign
      if (is_sphere && normal.dot(at_a.position - c.pos) < 0) normal = -normal;
      contacts.push_back({c.pos, normal, is_sphere ? std::abs(c.penetration_depth) : c.penetration_depth,
                          std::int64_t(exchanged ? c.b1 : c.b2)});
    }
  }

 private:
  const std::vector<Geometry>& geometries_;
  const fcl::CollisionRequestd request_;
  fcl::CollisionResultd result_;
};

}  // namespace

void FclEngine::add(const CollisionGeometry& geometry) {
  geometries_.push_back(geometry_of(geometry));
  geometries_.back()->computeLocalAABB();
}

std::unique_ptr<contact_geometry::NarrowPhase> FclEngine::make_narrow_phase() const {
  return std::make_unique<FclNarrowPhase>(geometries_);
}

}  // namespace muro::fcl_collision
