// SPDX-License-Identifier: MIT
// Compares shapes on heightmaps with FCL (Pan, Chitta, Manocha: FCL: A general purpose library for collision and
// proximity queries, ICRA 2012), which finds whether a shape touches the triangles. Random shapes of 0.05 to 2 m are
// lowered until they do.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "plugins/common/heightmap/heightmap_file.hpp"
#include "terrain_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

/// A heightmap at the world's origin, and a shape over it, as objects of FCL.
class Lowered {
 public:
  explicit Lowered(const native::testing::Ground& ground) : mesh_(std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>()) {
    const mesh::Mesh surface = heightmap::mesh_of(ground.map);
    std::vector<fcl::Triangle> triangles;
    for (const mesh::Triangle& t : surface.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    mesh_->beginModel();
    mesh_->addSubModel(surface.vertices, triangles);
    mesh_->endModel();
  }
  bool touches(const TransformedShape& s) const {
    const fcl::CollisionObjectd ground(mesh_), solid(geometry(s), s.axes, s.centre);
    fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    fcl::collide(&ground, &solid, request, result);
    return result.isCollision();
  }
  /// Lowers a shape that is above the ground to where it just does not touch.
  void lower(TransformedShape& s) const {
    double free = s.centre.z(), touching = free;
    while (!touches(s)) free = s.centre.z(), s.centre.z() -= 0.3 * s.half.minCoeff(), touching = s.centre.z();
    while (free - touching > 1e-9) {
      s.centre.z() = 0.5 * (free + touching);
      (touches(s) ? touching : free) = s.centre.z();
    }
    s.centre.z() = free;
  }

 private:
  static std::shared_ptr<fcl::CollisionGeometryd> geometry(const TransformedShape& s) {
    switch (s.kind) {
      case ShapeKind::box:
        return std::make_shared<fcl::Boxd>(2 * s.half);
      case ShapeKind::sphere:
        return std::make_shared<fcl::Sphered>(s.radius());
      case ShapeKind::cylinder:
        return std::make_shared<fcl::Cylinderd>(s.radius(), 2 * s.half.z());
      default:
        return std::make_shared<fcl::Capsuled>(s.radius(), 2 * s.half.z());
    }
  }
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> mesh_;
};

class TerrainWithKind : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(TerrainWithKind, TouchesWhereFclSaysSoAndAsDeepAsTheShapeWasLowered) {
  const native::testing::Ground grounds[] = {hills(), rocks(7), hills(97)};
  Randoms random(200 + unsigned(GetParam()));
  for (const native::testing::Ground& ground : grounds) {
    const Lowered lowered(ground);
    for (int i = 0; i < 50; ++i) {
      const Shape shape = random.shape(GetParam());
      const Quat turn = i % 3 == 0 ? random.right_angles() : random.rotation();
      TransformedShape solid = transformed(shape, {{random.uniform(-3, 3), random.uniform(-3, 3), 0}, turn});
      const double size = size_of(solid);
      solid.centre.z() = 0.6 + size;
      lowered.lower(solid);
      TransformedShape above = solid, below = solid;
      above.centre.z() += 1e-5 * size;
      EXPECT_TRUE(ground.contacts(above).empty()) << i << ", depth " << ground.lift(above) << ", size " << size;
      const double depth = 2e-4 * size;
      below.centre.z() -= depth;
      EXPECT_NEAR(ground.lift(below), depth, 0.2 * depth) << i << ", size " << size;
    }
  }
}

std::string name_of_kind(const ::testing::TestParamInfo<ShapeKind>& info) {
  constexpr const char* names[] = {"Box", "Sphere", "Cylinder", "Capsule"};
  return names[int(info.param)];
}

INSTANTIATE_TEST_SUITE_P(All, TerrainWithKind,
                         ::testing::Values(ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule),
                         name_of_kind);

}  // namespace
