// SPDX-License-Identifier: MIT
// First readings of an accelerometer, before the first step, for turned robots and scenery, and for meshes. Robots that
// stand on something read their weight; robots in the air are in free fall.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/sensor/case.hpp"
#include "tests/support/files.hpp"

namespace muro::sensor_conformance {
namespace {

const Vec3 cube_low(-0.1, -0.1, 0.2), cube_high(0.1, 0.1, 0.4);  // of a cube beside the origin of its file

struct MeshScene : test::Scene {
  test::ScratchFolder folder;
  std::string cube = folder.file("cube.stl", mesh::testing::stl_text(mesh::testing::box(cube_low, cube_high)));

  Shape mesh(const std::string& file, double scale = 1) {
    Shape s{.kind = ShapeKind::mesh, .size = Vec3::Constant(scale)};
    s.mesh = world().intern(file);
    return s;
  }
  void add_scenery_mesh(const std::string& file, const Vec3& at, double scale = 1) {
    const Shape shape = mesh(file, scale);
    world().add_scenery("scenery", {at, Quat::Identity()}, std::span<const Shape>(&shape, 1));
  }
  /// Returns the first reading of a robot with this cube, whose file has its origin at `at`.
  Vec3 first(const std::string& motion, const Pose& at, double scale = 1) {
    return first(motion, at, {.kind = ShapeKind::mesh, .size = Vec3::Constant(scale)});
  }
  /// Returns the first reading of a robot with this shape.
  Vec3 first(const std::string& motion, const Pose& at, Shape shape) {
    const RobotView& r = add("r", test::tree_of([&](RobotBuilder& b) {
                               if (shape.kind == ShapeKind::mesh) shape.mesh = b.intern(cube);
                               b.base("body");
                               b.set(keys::inertial, test::solid_box(1, {0.2, 0.2, 0.2}));
                               b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
                             }),
                             at);
    const ObjectId sensor = add_sensor_object(r, "sensor", r.base());
    use(motion, 1000, {{&r, r.base()}});
    use("sensor.accelerometer", 1000, {{&r, sensor}});
    use_contacts();
    build();
    run_for(0.0005);
    return world().value(sensor, keys::linear_acceleration);
  }
};

class FirstReading : public ::testing::TestWithParam<std::string> {};

TEST_P(FirstReading, OfAMeshInTheAirIsNothing) {
  for (const Pose& at : {Pose{{0, 0, -0.19}, Quat::Identity()}, Pose{{0, 0, 0.42}, from_rpy(M_PI, 0, 0)}}) {
    MeshScene s;
    s.add_ground();
    EXPECT_LT(s.first(GetParam(), at).norm(), 1e-9) << "its lower side is 1 or 2 cm above the ground";
  }
}

TEST_P(FirstReading, OfAMeshOnTheGroundIsItsWeight) {
  for (const double scale : {1.0, 2.0}) {
    MeshScene s;
    s.add_ground();
    const Vec3 seen = s.first(GetParam(), {{0, 0, -0.2 * scale}, Quat::Identity()}, scale);
    EXPECT_LT((seen - Vec3(0, 0, g)).norm(), 1e-9) << scale;
  }
}

/// Checks a cube that stands on an edge above a slope; a box around it would reach into the ground.
TEST_P(FirstReading, OfAMeshNearASlopeIsThatOfItsHull) {
  const Quat tilt = from_rpy(0, 0.5, 0);
  for (const double gap : {0.0, 0.01}) {
    MeshScene s;
    s.add_ground(0.8, {Vec3::Zero(), tilt});
    const Vec3 seen = s.first(GetParam(), {tilt * Vec3(0, 0, gap - 0.2), tilt});
    EXPECT_NEAR(seen.norm(), gap > 0 ? 0 : g, 1e-9);
  }
}

/// Checks a turned cylinder and capsule; boxes around them would reach deeper than the shapes.
TEST_P(FirstReading, OfATurnedRoundBodyIsThatOfItsShape) {
  constexpr double angle = 0.8, radius = 0.1, length = 0.2;
  const double of_rim = radius * std::sin(angle) + 0.5 * length * std::cos(angle),
               of_ball = radius + 0.5 * length * std::cos(angle);
  for (const auto& [shape, height] :
       {std::pair(Shape::cylinder(radius, length), of_rim), std::pair(Shape::capsule(radius, length), of_ball)})
    for (const double gap : {0.0, 0.01}) {
      MeshScene s;
      s.add_ground();
      const Vec3 seen = s.first(GetParam(), {{0, 0, height + gap}, from_rpy(0, 0, 0.7) * from_rpy(angle, 0, 0)}, shape);
      EXPECT_NEAR(seen.norm(), gap > 0 ? 0 : g, 1e-9) << "gap " << gap;
    }
}

TEST_P(FirstReading, BesideAMeshOfTheSceneryIsNothing) {
  MeshScene s;
  s.add_scenery_mesh(s.cube, {0.5, 0, 0});
  EXPECT_LT(s.first(GetParam(), {{0, 0, 0}, Quat::Identity()}).norm(), 1e-9);
}

TEST_P(FirstReading, OnAMeshOfTheSceneryIsItsWeight) {
  MeshScene s;
  s.add_scenery_mesh(s.cube, {0, 0, -1}, 3);  // its upper side at 0.2
  EXPECT_LT((s.first(GetParam(), {{0, 0, 0}, Quat::Identity()}) - Vec3(0, 0, g)).norm(), 1e-9);
}

std::vector<std::string> motions_of_forces() {
  std::vector<std::string> some = motions();
  std::erase_if(some, [](const std::string& motion) { return family_of(motion) != Family::forces; });
  return some;
}
INSTANTIATE_TEST_SUITE_P(, FirstReading, ::testing::ValuesIn(motions_of_forces()),
                         [](const auto& test) { return test.param.substr(7); });

}  // namespace
}  // namespace muro::sensor_conformance
