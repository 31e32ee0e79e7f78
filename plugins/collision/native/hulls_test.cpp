// SPDX-License-Identifier: MIT
// Compares hulls and triangles with results that are known in other ways.
#include "hulls/expanding_polytope.hpp"
#include "hulls/hull_plane.hpp"
#include "hulls/mesh_pairs.hpp"
#include "pairs_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

mesh::Hull hull_of_cloud(Randoms& random, int points, const Vec3& half) {
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(half.cwiseProduct(random.direction()));
  return mesh::convex_hull(cloud);
}

mesh::Hull hull_of_box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return mesh::convex_hull(corners);
}

CollisionGeometry geometry_of(const mesh::Hull& hull) {
  CollisionGeometry g;
  g.shape.kind = ShapeKind::mesh;
  g.hull = &hull;
  for (const Vec3& v : hull.vertices) g.box.include({v, v});
  return g;
}

std::vector<ContactPoint> contacts(const CollisionObject& a, const HullSupport* hull_a, const CollisionObject& b,
                                   const HullSupport* hull_b = nullptr) {
  std::vector<ContactPoint> points;
  collide_geometries(a, hull_a, b, hull_b, points);
  return points;
}

double deepest_of(const std::vector<ContactPoint>& points) {
  double depth = 0;
  for (const ContactPoint& p : points) depth = std::max(depth, p.depth);
  return depth;
}

TEST(HullSupport, FindsTheFarthestOfManyVerticesByWalkingAlongEdges) {
  Randoms random(1);
  for (const int points : {10, 100, 3000}) {
    const mesh::Hull hull = hull_of_cloud(random, points, {1, 0.2, 0.05});
    const HullSupport support(hull);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 n = random.direction();
      double farthest = -1;
      for (const Vec3& v : hull.vertices) farthest = std::max(farthest, v.dot(n));
      EXPECT_NEAR(support(n).dot(n), farthest, 1e-6);
    }
  }
}

TEST(LeastTranslation, OfTheHullsOfTwoBoxesIsThatOfTheBoxes) {
  Randoms random(2);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const Shape box[2] = {random.shape(ShapeKind::box), random.shape(ShapeKind::box)};
    const auto turn = [&] { return i % 3 == 0 ? random.right_angles() : random.rotation(); };
    const Pose at[2] = {
        {Vec3::Zero(), turn()},
        {0.5 * (box[0].size.norm() + box[1].size.norm()) * random.uniform(0, 0.7) * random.direction(), turn()}};
    Manifold boxes;
    collide_shapes(transformed(box[0], at[0]), transformed(box[1], at[1]), boxes);
    const double size = box[0].size.norm() + box[1].size.norm();
    const mesh::Hull hull[2] = {hull_of_box(0.5 * box[0].size), hull_of_box(0.5 * box[1].size)};
    const HullSupport support[2] = {HullSupport(hull[0]), HullSupport(hull[1])};
    const CollisionGeometry geometry[2] = {geometry_of(hull[0]), geometry_of(hull[1])};
    const auto points =
        contacts(collision_object(geometry[0], at[0]), &support[0], collision_object(geometry[1], at[1]), &support[1]);
    const double depth = boxes.count > 0 ? deepest(boxes)->depth : 0;
    EXPECT_NEAR(deepest_of(points), depth, 1e-8 * size) << i;
    touching += depth > 0;
  }
  EXPECT_GT(touching, 700);
}

/// Makes a square with sides of 2 `half` (m) at height 0, of `cells` times `cells` squares of two triangles each.
mesh::Mesh floor_of(double half, int cells) {
  mesh::Mesh m;
  for (int i = 0; i <= cells; ++i)
    for (int k = 0; k <= cells; ++k)
      m.vertices.push_back({2 * half * i / cells - half, 2 * half * k / cells - half, 0});
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const auto a = std::uint32_t((cells + 1) * i + k), b = a + std::uint32_t(cells) + 1;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

TEST(Triangles, AFloorOfTrianglesIsAsDeepAsAPlaneAndPushesUpOnly) {
  const mesh::Mesh floor = floor_of(4, 16);
  const ExactMesh exact(floor);
  CollisionGeometry ground;
  ground.shape.kind = ShapeKind::mesh;
  ground.exact_mesh = &exact;
  ground.box = mesh::bounds_of(floor);
  const CollisionObject triangles = collision_object(ground, {});
  Randoms random(3);
  const mesh::Hull hull = hull_of_cloud(random, 60, {0.5, 0.3, 0.2});
  const HullSupport support(hull);
  for (const ShapeKind kind :
       {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule, ShapeKind::mesh})
    for (int i = 0; i < 200; ++i) {
      CollisionGeometry geometry;
      geometry.shape = kind == ShapeKind::mesh ? Shape{.kind = ShapeKind::mesh} : random.shape(kind);
      if (kind == ShapeKind::mesh) geometry = geometry_of(hull);
      Pose at{{random.uniform(-1, 1), random.uniform(-1, 1), 0},
              i % 4 == 0 ? random.right_angles() : random.rotation()};
      CollisionObject object = collision_object(geometry, at);
      const double low = support_point(object, -Vec3::UnitZ()).z(), size = bounding_radius(geometry),
                   depth = size * random.uniform(-0.002, 0.002);
      at.position.z() = -low - depth;
      object = collision_object(geometry, at);
      const auto points = contacts(object, kind == ShapeKind::mesh ? &support : nullptr, triangles);
      EXPECT_NEAR(deepest_of(points), std::max(0.0, depth), 1e-6 * size) << int(kind) << ' ' << i;
      for (const ContactPoint& p : points) EXPECT_GT(p.normal.z(), 1 - 1e-6) << int(kind) << ' ' << i;
    }
}

TEST(Triangles, ASlimTipOnAnEdgeBetweenTrianglesIsHeld) {
  const mesh::Mesh floor = floor_of(4, 16);
  const ExactMesh exact(floor);
  CollisionGeometry ground;
  ground.shape.kind = ShapeKind::mesh;
  ground.exact_mesh = &exact;
  ground.box = mesh::bounds_of(floor);
  std::vector<Vec3> cloud{Vec3::Zero()};
  for (int i = 0; i < 8; ++i) cloud.push_back({0.05 * std::cos(M_PI * i / 4), 0.05 * std::sin(M_PI * i / 4), 0.3});
  const mesh::Hull hull = mesh::convex_hull(cloud);
  const HullSupport support(hull);
  const CollisionGeometry spike = geometry_of(hull);
  for (const Vec3& at : {Vec3(0.5, 0.2, -1e-4), Vec3(0.7, 0.7, -1e-4), Vec3(0.5, 0.5, -1e-4)}) {
    const auto points =
        contacts(collision_object(spike, {at, Quat::Identity()}), &support, collision_object(ground, {}));
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].depth, 1e-4, 1e-9);
    EXPECT_LT((points[0].normal - Vec3::UnitZ()).norm(), 1e-9);
  }
}

TEST(Triangles, ACapsuleThatASharpRidgeCutsIsPushedOffIt) {
  // a roof along y of two planes of 45 degrees, its ridge at height 0
  mesh::Mesh roof;
  roof.vertices = {{-1, -1, -1}, {-1, 1, -1}, {0, -1, 0}, {0, 1, 0}, {1, -1, -1}, {1, 1, -1}};
  roof.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  const ExactMesh exact(roof);
  CollisionGeometry ground;
  ground.shape.kind = ShapeKind::mesh;
  ground.exact_mesh = &exact;
  ground.box = mesh::bounds_of(roof);
  CollisionGeometry capsule;
  capsule.shape = Shape::capsule(0.1, 0.4);
  const Pose at{{0, 0.1, 0.09}, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()))};
  const auto points = contacts(collision_object(capsule, at), nullptr, collision_object(ground, {}));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].depth, 0.01, 1e-9);
  EXPECT_LT((points[0].normal - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((points[0].point - Vec3(0, 0.1, -0.005)).norm(), 1e-6);
}

TEST(HullOnPlane, GivesItsLowestVerticesAndOfManyTheOutermost) {
  std::vector<Vec3> cloud;
  for (int i = 0; i < 40; ++i)
    for (const double z : {-0.1, 0.1})
      cloud.push_back({0.3 * std::cos(2 * M_PI * i / 40), 0.3 * std::sin(2 * M_PI * i / 40), z});
  KernelShape disc = kernel_shape_of(Shape::box({0.6, 0.6, 0.2}));
  disc.kind = KernelShapeKind::mesh;
  disc.vertices = cloud.data()->data();
  disc.vertex_count = int(cloud.size());
  const TransformedShape plane = transformed(Shape::plane(), {});
  std::vector<ContactPoint> flat, on_edge;
  add_hull_on_plane(disc, {{1, 2, 0.09}, Quat::Identity()}, plane, flat);
  ASSERT_EQ(flat.size(), 8u);
  Vec3 middle = Vec3::Zero();
  for (const ContactPoint& p : flat) {
    EXPECT_NEAR(p.depth, 0.01, 1e-12);
    EXPECT_EQ(p.normal, Vec3::UnitZ());
    EXPECT_NEAR((p.point - Vec3(1, 2, -0.005)).norm(), 0.3, 1e-9);
    middle += p.point / 8;
  }
  EXPECT_LT((middle - Vec3(1, 2, -0.005)).norm(), 0.1);
  add_hull_on_plane(disc, {{0, 0, 0.3 - 1e-4}, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()))}, plane, on_edge);
  EXPECT_EQ(on_edge.size(), 2u);
}

}  // namespace
