// SPDX-License-Identifier: MIT
// Places of scenery and robots whose shapes are meshes, and the inertia of a body that is a mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

class AMesh : public testing::Test {
 protected:
  AMesh() {
    folder_.file("crate.stl", mesh::testing::stl_text(mesh::testing::box({-0.5, -0.2, -0.3}, {0.5, 0.2, 0.1})));
  }

  BuiltScenario built(const std::string& scenario) {
    return build(read_scenario(folder_.file("s.yaml", scenario), {}), test::plugins());
  }
  /// Builds a robot whose collision shape is the mesh, turned and scaled.
  BuiltScenario built_urdf(const std::string& origin, const std::string& scale) {
    folder_.file("r.urdf", R"(<robot name="r"><link name="base"><collision><origin )" + origin +
                               R"(/><geometry><mesh filename="crate.stl" scale=")" + scale +
                               R"("/></geometry></collision></link></robot>)");
    return built("robots: {r: {model: r.urdf}}\n");
  }
  static double height(const BuiltScenario& b, std::string_view name) {
    const World& world = b.simulation->world();
    return world.value(world.find_object(name), keys::pose).position.z();
  }
  test::ScratchFolder folder_;
};

TEST_F(AMesh, OfSceneryStandsOnTheGround) {
  const BuiltScenario b = built("world: {objects: {crate: {shape: {mesh: crate.stl}}}}\n");
  EXPECT_NEAR(height(b, "crate"), 0.3, 1e-6) << "its lowest point is 0.3 m below its origin";
}

TEST_F(AMesh, OfSceneryWithAHeightStandsThere) {
  const BuiltScenario b = built("world: {objects: {crate: {shape: {mesh: crate.stl}, at: {z: 0.05}}}}\n");
  EXPECT_EQ(height(b, "crate"), 0.05);
}

TEST_F(AMesh, OfARobotStandsOnTheGroundHoweverItIsTurnedAndScaled) {
  EXPECT_NEAR(height(built_urdf(R"(xyz="0 0 0")", "1 1 1"), "r/base"), 0.3, 1e-6);
  EXPECT_NEAR(height(built_urdf(R"(xyz="0 0 1")", "1 1 2"), "r/base"), -0.4, 1e-6) << "its lowest point is above";
  EXPECT_NEAR(height(built_urdf(R"(rpy="0 0.5 0")", "1 1 1"), "r/base"), 0.5 * std::sin(0.5) + 0.3 * std::cos(0.5),
              1e-6)
      << "a corner is the lowest point";
}

TEST_F(AMesh, WithAMassIsAHomogeneousBody) {
  const BuiltScenario b = built("robots: {crate: {shape: {mesh: crate.stl}, mass: 3}}\n");
  const World& world = b.simulation->world();
  const Inertia i = world.value(world.robots()[0]->base(), keys::inertial);
  EXPECT_EQ(i.mass, 3);
  EXPECT_NEAR((i.com - Vec3(0, 0, -0.1)).norm(), 0, 1e-6);
  EXPECT_NEAR(i.ixx, 3 * (0.4 * 0.4 + 0.4 * 0.4) / 12, 1e-6);
  EXPECT_NEAR(i.izz, 3 * (1.0 * 1.0 + 0.4 * 0.4) / 12, 1e-6);
  EXPECT_NEAR(height(b, "crate/body"), 0.3, 1e-6);
}

TEST_F(AMesh, IsARobotWhereItsFileIsTheModel) {
  const BuiltScenario b = built("robots: {crate: {model: crate.stl}}\n");
  const World& world = b.simulation->world();
  EXPECT_NEAR(world.value(world.robots()[0]->base(), keys::inertial).mass, 1000 * 1.0 * 0.4 * 0.4, 1e-3);
}

TEST_F(AMesh, ThatIsFlatIsNoBodyWithAMass) {
  mesh::Mesh flat = mesh::testing::box({0, 0, 0}, {1, 1, 1});
  flat.triangles.resize(2);
  folder_.file("flat.stl", mesh::testing::stl_text(flat));
  EXPECT_SAYS(test::complaint_of([&] { built("robots: {sheet: {shape: {mesh: flat.stl}, mass: 3}}\n"); }),
              "flat.stl is flat and has no volume");
}

TEST_F(AMesh, OfSceneryIsWhereRandomRobotsAreNot) {
  const BuiltScenario b = built(
      "world:\n  objects: {rock: {shape: {mesh: crate.stl}, at: {x: 1.5}}}\n"
      "  places: {yard: [{center: [1, 0], size: [3, 0.3]}]}\n"
      "robots: {ball: {shape: {sphere: 0.1}, mass: 1, count: 4, place: {random: yard}}}\n");
  const World& world = b.simulation->world();
  for (const RobotView* r : world.robots()) {
    const Vec3 at = world.value(r->base(), keys::pose).position;
    EXPECT_TRUE(std::abs(at.x() - 1.5) > 0.6 || std::abs(at.y()) > 0.3) << at.transpose();
  }
}

}  // namespace
}  // namespace muro::host
