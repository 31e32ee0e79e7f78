// SPDX-License-Identifier: MIT
// Compares hulls with FCL (Pan, Chitta, Manocha: FCL: A general purpose library for collision and proximity queries,
// ICRA 2012) and with the separating axis theorem, on 10 000 random pairs of 0.05 to 2 m in random and in axis-parallel
// places.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "hulls/hull_plane.hpp"
#include "hulls/mesh_pairs.hpp"
#include "pairs_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

/// A shape and all data that the pairs need of it.
struct Solid {
  mesh::Hull hull;
  std::unique_ptr<HullSupport> support;
  CollisionGeometry geometry;
  CollisionObject object;

  bool is_hull() const { return support != nullptr; }
  void put(const Pose& pose) { object = collision_object(geometry, pose); }
  /// Returns the farthest extent (m) along the unit vector n, from the world's origin.
  double extent(const Vec3& n) const {
    if (!is_hull()) return native::testing::extent(object.shape, n);
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : hull.vertices) reach = std::max(reach, n.dot(object.pose * v));
    return reach;
  }
  double size() const { return bounding_radius(geometry); }
};

std::unique_ptr<Solid> primitive(const Shape& shape) {
  auto solid = std::make_unique<Solid>();
  solid->geometry.shape = shape;
  return solid;
}

/// Makes the hull of `points` random points in a box, or on an ellipsoid.
std::unique_ptr<Solid> random_hull(Randoms& random, int points) {
  const Vec3 half(random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1));
  const bool round = random.below(2) == 0;
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i)
    cloud.push_back(half.cwiseProduct(
        round ? random.direction() : Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))));
  auto solid = std::make_unique<Solid>();
  solid->hull = mesh::convex_hull(cloud);
  solid->support = std::make_unique<HullSupport>(solid->hull);
  solid->geometry.shape.kind = ShapeKind::mesh;
  solid->geometry.hull = &solid->hull;
  for (const Vec3& v : solid->hull.vertices) solid->geometry.box.include({v, v});
  return solid;
}

KernelShape kernel_shape_of(const Solid& s) {
  const Aabb& box = s.geometry.box;
  Shape around = Shape::box(box.high - box.low);
  around.origin.position = 0.5 * (box.low + box.high);
  KernelShape shape = native::kernel_shape_of(around);
  shape.kind = KernelShapeKind::mesh;
  shape.vertices = s.hull.vertices.data()->data();
  shape.vertex_count = int(s.hull.vertices.size());
  return shape;
}

std::shared_ptr<fcl::CollisionGeometryd> geometry(const Solid& s) {
  const TransformedShape& t = s.object.shape;
  if (s.is_hull()) {
    auto faces = std::make_shared<std::vector<int>>();
    for (const mesh::Hull::Face& f : s.hull.faces) {
      faces->push_back(int(f.count));
      for (const std::uint32_t c : s.hull.corners_of(f)) faces->push_back(int(c));
    }
    return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Vec3>>(s.hull.vertices),
                                          int(s.hull.faces.size()), faces);
  }
  switch (t.kind) {
    case ShapeKind::box:
      return std::make_shared<fcl::Boxd>(2 * t.half);
    case ShapeKind::sphere:
      return std::make_shared<fcl::Sphered>(t.radius());
    case ShapeKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(t.radius(), 2 * t.half.z());
    case ShapeKind::capsule:
      return std::make_shared<fcl::Capsuled>(t.radius(), 2 * t.half.z());
    default:
      return std::make_shared<fcl::Halfspaced>(Vec3::UnitZ(), 0);
  }
}

/// Returns the depth of FCL's deepest contact; 0 when apart. Except for planes it comes from the portal refinement of
/// libccd, which gives a translation that separates, but not the least.
double fcl_depth(const Solid& a, const Solid& b) {
  fcl::CollisionRequestd request(16, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = 1e-10;
  fcl::CollisionResultd result;
  const auto object = [](const Solid& s) {
    return fcl::CollisionObjectd(geometry(s), s.object.pose.orientation.toRotationMatrix(), s.object.pose.position);
  };
  const auto first = object(a), second = object(b);
  fcl::collide(&first, &second, request, result);
  double depth = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, std::abs(result.getContact(i).penetration_depth));
  return depth;
}

double depth_along(const Solid& a, const Solid& b, const Vec3& n) { return b.extent(n) + a.extent(-n); }

/// Normals of faces and directions of edges of a hull or box, in the world.
struct Axes {
  std::vector<Vec3> faces, edges;

  explicit Axes(const Solid& s) {
    const Quat& turn = s.object.pose.orientation;
    if (!s.is_hull())
      for (int k = 0; k < 3; ++k) faces.push_back(s.object.shape.axes.col(k)), edges.push_back(faces.back());
    for (const mesh::Hull::Face& f : s.hull.faces) {
      faces.push_back(turn * f.normal);
      const auto c = s.hull.corners_of(f);
      for (std::size_t k = 0; k < c.size(); ++k)
        if (c[k] < c[(k + 1) % c.size()])
          edges.push_back((turn * (s.hull.vertices[c[(k + 1) % c.size()]] - s.hull.vertices[c[k]])).normalized());
    }
  }
};

/// Returns the least depth of two polyhedra by the separating axis theorem; negative: apart.
double least_depth(const Solid& a, const Solid& b) {
  const Axes of_a(a), of_b(b);
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& n) { least = std::min({least, depth_along(a, b, n), depth_along(a, b, -n)}); };
  for (const Vec3& n : of_a.faces) consider(n);
  for (const Vec3& n : of_b.faces) consider(n);
  for (const Vec3& u : of_a.edges)
    for (const Vec3& v : of_b.edges)
      if (const Vec3 n = u.cross(v); n.squaredNorm() > 1e-12) consider(n.normalized());
  return least;
}

class HullsWithKind : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(HullsWithKind, TouchWhereFclSaysSoWithTheLeastDepth) {
  const ShapeKind kind = GetParam();
  Randoms random(100 + unsigned(kind));
  const int pairs = 1700;
  const double band = 1e-6;  // part of the size: closer to touching, the two may disagree
  int touching = 0;
  for (int i = 0; i < pairs; ++i) {
    const bool parallel = random.below(4) == 0;
    const auto turn = [&] { return parallel ? random.right_angles() : random.rotation(); };
    const auto a = random_hull(random, 5 + int(random.below(i % 20 == 0 ? 300 : 30)));
    const auto b =
        kind == ShapeKind::mesh ? random_hull(random, 5 + int(random.below(30))) : primitive(random.shape(kind));
    const Vec3 aside = random.direction();
    const Pose place{10 * random.direction(), turn()};
    b->put({Vec3::Zero(), turn()});
    a->put(place);
    const bool is_plane = kind == ShapeKind::plane;
    const Vec3 aim = is_plane ? Vec3(-b->object.shape.axis()) : aside;
    const double reach = a->extent(aim) - place.position.dot(aim) + (is_plane ? 0 : b->extent(-aim));
    b->put({place.position + aim * (reach * random.uniform(0.35, is_plane ? 1.65 : 1.2)), b->object.pose.orientation});
    const double size = a->size() + b->size();

    std::vector<ContactPoint> points;
    if (is_plane)
      add_hull_on_plane(kernel_shape_of(*a), place, b->object.shape, points);
    else
      collide_geometries(a->object, a->support.get(), b->object, b->support.get(), points);
    const double fcl = fcl_depth(*a, *b);
    if (points.empty()) {
      EXPECT_LT(fcl, band * size) << "pair " << i;
      continue;
    }
    ++touching;
    EXPECT_LE(points.size(), 9u);
    const ContactPoint& c =
        *std::max_element(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.depth < q.depth; });
    EXPECT_NEAR(c.normal.norm(), 1, 1e-12);
    if (is_plane) {
      EXPECT_NEAR(c.depth, fcl, 1e-9 * size) << "pair " << i;
      continue;
    }
    EXPECT_LT(c.depth, fcl + band * size) << "pair " << i;
    // Along the normal the shapes overlap by the depth, and in no direction by less.
    EXPECT_NEAR(depth_along(*a, *b, c.normal), c.depth, 1e-9 * size) << "pair " << i;
    if (kind == ShapeKind::mesh || kind == ShapeKind::box) {
      if (a->hull.vertices.size() < 40) {
        EXPECT_NEAR(least_depth(*a, *b), c.depth, 1e-7 * size) << "pair " << i;
      }
    } else {
      for (const Vec3& n : directions(300)) EXPECT_GE(depth_along(*a, *b, n), c.depth - 1e-7 * size) << "pair " << i;
    }
  }
  EXPECT_GT(touching, 0.35 * pairs);
  EXPECT_LT(touching, 0.75 * pairs);
}

std::string name_of_kind(const ::testing::TestParamInfo<ShapeKind>& info) {
  constexpr const char* names[] = {"Box", "Sphere", "Cylinder", "Capsule", "Plane", "Hull"};
  return names[int(info.param)];
}

INSTANTIATE_TEST_SUITE_P(All, HullsWithKind,
                         ::testing::Values(ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule,
                                           ShapeKind::plane, ShapeKind::mesh),
                         name_of_kind);

}  // namespace
