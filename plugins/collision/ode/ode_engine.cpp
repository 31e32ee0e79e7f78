// SPDX-License-Identifier: MIT
#include "ode_engine.hpp"

#include <array>

#include "muro/algorithm.hpp"

namespace muro::ode_collision {
namespace {

using contact_geometry::CollisionGeometry;
using contact_geometry::EngineContact;

void plan_hull(const mesh::Hull& hull, GeomPlan& plan) {
  for (const Vec3& v : hull.vertices) plan.middle += v / double(hull.vertices.size());
  for (const Vec3& v : hull.vertices) {
    const Vec3 point = v - plan.middle;
    plan.points.insert(plan.points.end(), point.data(), point.data() + 3);
  }
  for (const mesh::Hull::Face& f : hull.faces) {
    const double offset = f.offset - f.normal.dot(plan.middle);
    plan.planes.insert(plan.planes.end(), {f.normal.x(), f.normal.y(), f.normal.z(), offset});
    const auto corners = hull.corners_of(f);
    plan.polygons.push_back(unsigned(corners.size()));
    plan.polygons.insert(plan.polygons.end(), corners.begin(), corners.end());
  }
}

mesh::Hull box_of(const Vec3& half) {
  mesh::Hull hull;
  for (int i = 0; i < 8; ++i)
    hull.vertices.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  hull.corners = {1, 3, 7, 5, 0, 4, 6, 2, 2, 6, 7, 3, 0, 1, 5, 4, 4, 5, 7, 6, 0, 2, 3, 1};
  for (unsigned f = 0; f < 6; ++f)
    hull.faces.push_back({4 * f, 4, (f & 1 ? -1.0 : 1.0) * Vec3::Unit(f / 2), half[f / 2]});
  return hull;
}

void plan_mesh(const mesh::Mesh& surface, GeomPlan& plan) {
  for (const Vec3& v : surface.vertices) plan.vertices.insert(plan.vertices.end(), v.data(), v.data() + 3);
  for (const mesh::Triangle& t : surface.triangles) plan.indices.insert(plan.indices.end(), t.begin(), t.end());
  plan.mesh = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(plan.mesh, plan.vertices.data(), 3 * sizeof(dReal), int(surface.vertices.size()),
                              plan.indices.data(), int(plan.indices.size()), 3 * sizeof(dTriIndex));
  dGeomTriMeshDataPreprocess2(plan.mesh, 1U << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);  // needed by hulls
}

dGeomID polytope_of(const GeomPlan& plan) {
  return dCreateConvex(nullptr, plan.planes.data(), unsigned(plan.planes.size() / 4), plan.points.data(),
                       unsigned(plan.points.size() / 3), plan.polygons.data());
}

dGeomID geom_of(const GeomPlan& plan) {
  const Shape& shape = plan.geometry->shape;
  if (shape.kind == ShapeKind::plane) return dCreatePlane(nullptr, 0, 0, 1, 0);
  if (shape.kind != ShapeKind::mesh) return ode::create_primitive(shape, nullptr);
  if (plan.mesh) return dCreateTriMesh(nullptr, plan.mesh, nullptr, nullptr, nullptr);
  return polytope_of(plan);
}

struct GeomDeleter {
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
};
using Geom = std::unique_ptr<dxGeom, GeomDeleter>;

/// Whether ODE's result for a pair is rough. Some pairs go to libccd, whose portal refinement (Snethen, XenoCollide,
/// 2008) gives a way out, not the shortest. With a box, a capsule that overlaps deeply gets a wrong normal.
bool is_rough(int a, int b) {
  const auto round = [](int kind) { return kind == dCylinderClass || kind == dCapsuleClass; };
  if (a == dPlaneClass || b == dPlaneClass || a == dSphereClass || b == dSphereClass)
    return (a == dConvexClass && b == dSphereClass) || (a == dSphereClass && b == dConvexClass);
  if (a == dConvexClass || b == dConvexClass) return true;
  return (round(a) && round(b) && a + b != 2 * dCapsuleClass) || a + b == dCapsuleClass + dBoxClass;
}

class OdeNarrowPhase final : public contact_geometry::NarrowPhase {
 public:
  OdeNarrowPhase(const std::vector<std::unique_ptr<GeomPlan>>& plans, ode::MessageLog& messages)
      : plans_(plans), messages_(messages) {
    ode::prepare_this_thread();
    const ode::ErrorTrap trap(messages_);
    for (Side& side : sides_)
      for (const auto& plan : plans_) {
        side.geoms.emplace_back(geom_of(*plan));
        side.polytopes.emplace_back(plan->points.empty() ? nullptr : polytope_of(*plan));
      }
  }

  void collide(std::uint32_t a, const Pose& at_a, std::uint32_t b, const Pose& at_b,
               std::vector<EngineContact>& contacts) override {
    const ode::ErrorTrap trap(messages_);
    const bool as_polytope = kind_of(a) == ShapeKind::cylinder || kind_of(b) == ShapeKind::cylinder;
    dxGeom *const first = geom(0, a, as_polytope), *const second = geom(1, b, as_polytope);
    set_pose(first, at_a, *plans_[a]);
    set_pose(second, at_b, *plans_[b]);
    const int count = dCollide(first, second, int(contacts_.size()), contacts_.data(), sizeof contacts_[0]);
    // for a polytope and a mesh ODE does not name the triangle: its number is valid in this query only
    const bool names_triangles = plans_[b]->mesh && dGeomGetClass(first) != dConvexClass;
    const bool rough = is_rough(dGeomGetClass(first), dGeomGetClass(second));
    for (int i = 0; i < count; ++i) {
      const dContactGeom& c = contacts_[std::size_t(i)];
      const double side = c.g1 == first ? 1 : -1;
      contacts.push_back({{c.pos[0], c.pos[1], c.pos[2]},
                          side * Vec3(c.normal[0], c.normal[1], c.normal[2]),
                          c.depth,
                          names_triangles ? std::int64_t(c.g1 == first ? c.side2 : c.side1) : -1,
                          rough});
    }
  }

 private:
  static void set_pose(dxGeom* geom, const Pose& pose, const GeomPlan& plan) {
    if (dGeomGetClass(geom) == dPlaneClass) {
      const Vec3 n = pose.orientation * Vec3::UnitZ();
      dGeomPlaneSetParams(geom, n.x(), n.y(), n.z(), n.dot(pose.position));
      return;
    }
    dQuaternion q;
    ode::copy_quaternion(q, pose.orientation);
    const Vec3 at = dGeomGetClass(geom) == dConvexClass ? pose * plan.middle : pose.position;
    dGeomSetPosition(geom, at.x(), at.y(), at.z());
    dGeomSetQuaternion(geom, q);
  }

  ShapeKind kind_of(std::uint32_t geometry) const { return plans_[geometry]->geometry->shape.kind; }
  /// Returns a geom. With `as_polytope` a box is a polytope: ODE's collider of cylinder and box misses one in seven
  /// deep overlaps.
  dxGeom* geom(std::size_t side, std::uint32_t geometry, bool as_polytope) const {
    const Side& s = sides_[side];
    return as_polytope && s.polytopes[geometry] ? s.polytopes[geometry].get() : s.geoms[geometry].get();
  }

  struct Side {
    std::vector<Geom> geoms, polytopes;  ///< by number of the geometry; not all have a polytope
  };
  const std::vector<std::unique_ptr<GeomPlan>>& plans_;
  ode::MessageLog& messages_;
  std::array<Side, 2> sides_;  ///< for the first and the second of a pair
  std::array<dContactGeom, 1024> contacts_{};
};

}  // namespace

OdeEngine::OdeEngine() {
  ode::start_library();
  ode::prepare_this_thread();
}

OdeEngine::~OdeEngine() {
  for (const auto& plan : plans_)
    if (plan->mesh) dGeomTriMeshDataDestroy(plan->mesh);
}

void OdeEngine::use_log(Host& host) { messages_ = std::make_unique<ode::MessageLog>(host, "collision.ode"); }

void OdeEngine::add(const CollisionGeometry& geometry) {
  const ode::ErrorTrap trap(*messages_);
  auto plan = std::make_unique<GeomPlan>();
  plan->geometry = &geometry;
  if (geometry.hull) plan_hull(*geometry.hull, *plan);
  if (geometry.shape.kind == ShapeKind::box) plan_hull(box_of(0.5 * geometry.shape.size), *plan);
  if (geometry.exact_mesh) plan_mesh(geometry.exact_mesh->surface(), *plan);
  plans_.push_back(std::move(plan));
}

std::unique_ptr<contact_geometry::NarrowPhase> OdeEngine::make_narrow_phase() const {
  return std::make_unique<OdeNarrowPhase>(plans_, *messages_);
}

}  // namespace muro::ode_collision
