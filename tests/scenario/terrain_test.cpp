// SPDX-License-Identifier: MIT
// Places of scenery and robots in a scene with heightmaps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "host/outputs/free_camera.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/overlaps.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/hills.hpp"

namespace muro::host {
namespace {

/// A scene on a square of 32 m with nodes 0.5 m apart.
class OnTerrain : public testing::Test {
 protected:
  explicit OnTerrain(const test::Hills::Heights& height = [](double x, double y) { return 0.25 * x - 0.125 * y; })
      : hills_(32, 64, height) {}

  std::string scenario(const std::string& objects, const std::string& rest = "") const {
    return fmt::format(
        "world:\n  objects:\n    hills: {{shape: {{heightmap: {}, size: [32, 32, 1]}}}}\n{}\n"
        "  places: {{all: [{{center: [0, 0], size: [20, 20]}}]}}\n{}\n",
        hills_.path(), objects, rest);
  }
  BuiltScenario built(const std::string& objects, const std::string& rest = "") {
    return build(read_scenario(folder_.file("s.yaml", scenario(objects, rest)), {}), test::plugins());
  }
  std::string refused(const std::string& rest) {
    return test::complaint_of([&] { built("", rest); });
  }
  static Pose pose(const BuiltScenario& b, std::string_view name) {
    return b.simulation->world().value(b.simulation->world().find_object(name), keys::pose);
  }

  test::Hills hills_;
  test::ScratchFolder folder_;
};

TEST_F(OnTerrain, SceneryWithoutAHeightTouchesTheSlopeWithItsLowestEdge) {
  const BuiltScenario b = built(R"(    crate: {shape: {box: [1, 2, 0.5]}, at: {x: 4, y: 2}}
    turned: {shape: {box: [1, 2, 0.5]}, at: {x: 4, y: 2, yaw: 1.5707963267948966}}
    before: {shape: {box: [1, 2, 0.5]}, at: {x: 4, y: 2, z: 0.1}})");
  // the corner of its base at +x -y is over the highest ground
  EXPECT_NEAR(pose(b, "crate").position.z(), 0.25 * 4.5 - 0.125 * 1 + 0.25, 1e-9);
  EXPECT_NEAR(pose(b, "turned").position.z(), 0.25 * 5 - 0.125 * 1.5 + 0.25, 1e-9);
  EXPECT_EQ(pose(b, "before").position.z(), 0.1) << "a height that is given stays";
}

TEST_F(OnTerrain, WhatIsTurnedAsTheSlopeLiesFlatOnIt) {
  const Vec3 normal = Vec3(-0.25, 0.125, 1).normalized();
  const double roll = std::asin(-normal.y()), pitch = std::atan2(normal.x(), normal.z());
  const auto z_of = [&](const std::string& shape, const std::string& name) {
    return fmt::format("    {}: {{shape: {}, at: {{x: 4, y: 2, roll: {}, pitch: {}}}}}\n", name, shape, roll, pitch);
  };
  const BuiltScenario b = built(z_of("{box: [1, 2, 0.5]}", "crate") + z_of("{cylinder: [0.4, 0.6]}", "tin") +
                                z_of("{capsule: [0.1, 1]}", "pole"));
  const auto height = [&](const char* name) {  // of its origin over the slope, along the normal
    return (pose(b, name).position - Vec3(4, 2, 0.25 * 4 - 0.125 * 2)).dot(normal);
  };
  EXPECT_NEAR(height("crate"), 0.25, 1e-6);
  EXPECT_NEAR(height("tin"), 0.3, 1e-6);
  EXPECT_NEAR(height("pole"), 0.6, 1e-6);
}

TEST_F(OnTerrain, OfManyCopiesInAGridEachStandsOnItsOwnGround) {
  const BuiltScenario b =
      built("    crates: {shape: {box: [1, 1, 1]}, place: {grid: {count: [3, 2], spacing: [4, 4]}}}");
  for (int i = 0; i < 6; ++i) {
    const Vec3 p = pose(b, fmt::format("crates_{}", i)).position;
    EXPECT_NEAR(p.z(), 0.25 * (p.x() + 0.5) - 0.125 * (p.y() - 0.5) + 0.5, 1e-9) << i;
  }
}

TEST_F(OnTerrain, RobotsAtRandomPlacesStandOnTheGround) {
  const BuiltScenario b = built("", R"(robots:
  ball: {shape: {sphere: 0.3}, mass: 1, count: 20, place: {random: all}, motion: {use: motion.simplified, rate: 100}})");
  EXPECT_TRUE(b.notes.empty()) << b.notes.front();
  for (int i = 0; i < 20; ++i) {
    const Vec3 p = pose(b, fmt::format("ball_{}/body", i)).position;
    const double below = 0.25 * p.x() - 0.125 * p.y();
    EXPECT_NEAR(p.z(), below + 0.3 * Vec3(-0.25, 0.125, 1).norm(), 1e-6) << "it touches";
  }
}

TEST_F(OnTerrain, BeyondTheRimThingsStandAtZeroAsBefore) {
  const BuiltScenario b = built("    crate: {shape: {box: [1, 1, 1]}, at: {x: 40}}");
  EXPECT_EQ(pose(b, "crate").position.z(), 0.5);
}

TEST_F(OnTerrain, ATiltedHeightmapCarriesAsAnInclinedPlane) {
  const BuiltScenario b = build(read_scenario(folder_.file("s.yaml", fmt::format(R"(
world:
  objects:
    ball: {{shape: {{sphere: 0.5}}, at: {{x: 2, y: 1}}}}
    hills: {{shape: {{heightmap: {}, size: [32, 32, 1e-6]}}, at: {{z: 1, pitch: -0.3}}}}
)",
                                                                                 hills_.path())),
                                              {}),
                                test::plugins());
  const Vec3 ball = pose(b, "ball").position;
  const double distance = (from_rpy(0, -0.3, 0).conjugate() * Vec3(ball - Vec3(0, 0, 1))).z();
  EXPECT_NEAR(distance, 0.5, 1e-5) << "it touches, though it stands before the hills in the file";
}

TEST_F(OnTerrain, AKinematicRobotIsSettledExactly) {
  folder_.file("rover.urdf", R"(<robot name="rover"><link name="base"/>
  <link name="l"><collision><origin rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision></link>
  <link name="r"><collision><origin rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision></link>
  <joint name="left" type="continuous"><parent link="base"/><child link="l"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/></joint>
  <joint name="right" type="continuous"><parent link="base"/><child link="r"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/></joint>
</robot>)");
  const BuiltScenario b = built(
      "", "robots: {rover: {model: rover.urdf, at: {x: 3, y: 1, yaw: 0.4}, motion: {use: motion.differential_drive}}}");
  const Pose base = pose(b, "rover/base");
  for (const double y : {0.2, -0.2}) {
    const Vec3 lowest = base * Vec3(0, y, -0.1);
    EXPECT_NEAR(lowest.z(), 0.25 * lowest.x() - 0.125 * lowest.y(), 1e-6);
  }
  EXPECT_NEAR((base.orientation * Vec3::UnitZ()).dot(Vec3(-0.25, 0.125, 1).normalized()), 1, 1e-9)
      << "the ground holds it beside its wheels";
}

TEST_F(OnTerrain, ARobotThatIsBuriedIsTold) {
  const auto notes = [&](double z) {
    return built("", fmt::format("robots: {{box: {{shape: {{box: [0.4, 0.4, 0.4]}}, mass: 1, at: {{x: 4, z: {}}}, "
                                 "motion: {{use: motion.simplified, rate: 100}}}}}}",
                                 z))
        .notes;
  };
  EXPECT_EQ(notes(1.0 + 0.05 + 0.025 + 0.2 + 0.001), std::vector<std::string>{}) << "over the corner at +x -y";
  const std::vector<std::string> deep = notes(-3);
  ASSERT_EQ(deep.size(), 1u);
  // the corner at +x -y is 3 + 1.05 + 0.025 + 0.2 m below, along the normal
  EXPECT_EQ(deep[0].substr(deep[0].find("note: ")),
            fmt::format("note: `box/body` and `hills` overlap by {:.2g} m at the start; contacts push them "
                        "apart, so move one of them",
                        (3 + 1.05 + 0.025 + 0.2) / Vec3(-0.25, 0.125, 1).norm()));
}

TEST_F(OnTerrain, WhatNoContactMovesMayBePutIntoAHillWhereItStandsAnyway) {
  const BuiltScenario b = built("", R"(robots:
  moved: {shape: {box: [0.4, 0.4, 0.4]}, mass: 1, at: {x: 4}, motion: {use: motion.simplified, rate: 100}}
  point: {shape: {box: [0.4, 0.4, 0.4]}, mass: 1, at: {x: 6}, motion: {use: motion.point, height_above_ground: 0.2}})");
  const World& world = b.simulation->world();
  const auto overlap = [&](const char* robot, double x, double z) {
    ShapeFiles files(*b.simulation);
    return overlap_of(*b.simulation, files,
                      {.object = world.find_robot(robot)->base(), .pose = {{x, 8, z}, Quat::Identity()}});
  };
  EXPECT_EQ(overlap("moved", 4, -2).substr(0, 11), "`hills` by ");
  EXPECT_EQ(overlap("moved", 4, 2), "");
  EXPECT_EQ(overlap("point", 4, -2), "");
}

TEST_F(OnTerrain, AFileThatIsNoHeightmapIsToldOnceAtItsObject) {
  const std::string file = folder_.file("odd.png", "no picture");
  const std::string said = test::complaint_of(
      [&] { built(fmt::format("    odd: {{shape: {{heightmap: {}, size: [1, 1, 1]}}}}", file), "robots: {}"); });
  EXPECT_NE(said.find("s.yaml:4:10: object `odd`: "), std::string::npos) << said;
  EXPECT_NE(said.find("has 10 bytes and is neither a picture"), std::string::npos) << said;
  EXPECT_EQ(said.find("neither a picture"), said.rfind("neither a picture")) << said;
}

TEST_F(OnTerrain, ARobotWithAHeightmapIsRefusedInOneSentence) {
  const std::string advice =
      "has a heightmap as a collision shape, which only scenery can have; put `{heightmap: file, size: [x, y, z]}` "
      "into "
      "`world: objects` as the `shape` of an object";
  EXPECT_SAYS(
      refused(fmt::format("robots: {{hill: {{shape: {{heightmap: {}, size: [1, 1, 1]}}, mass: 1}}}}", hills_.path())),
      "robot `hill`: the link `body` " + advice);
  EXPECT_SAYS(refused(fmt::format("robots: {{hill: {{model: {}, motion: {{use: motion.simplified, base: fixed}}}}}}",
                                  hills_.path())),
              "robot `hill`: the link `body` " + advice);
}

class OnRoughTerrain : public OnTerrain {
 protected:
  OnRoughTerrain() : OnTerrain([](double x, double y) { return 0.6 * std::sin(1.3 * x) * std::cos(0.9 * y); }) {}
};

TEST_F(OnRoughTerrain, RobotsMovedByForcesStartAboveTheGroundWithoutOverlap) {
  const BuiltScenario b = built("", R"(robots:
  crate: {shape: {box: [1, 0.6, 0.4]}, mass: 1, count: 15, place: {random: all}, motion: {use: motion.simplified, rate: 100}}
  tin: {shape: {cylinder: [0.2, 0.6]}, mass: 1, count: 15, place: {random: all}, motion: {use: motion.simplified, rate: 100}})");
  EXPECT_TRUE(b.notes.empty()) << b.notes.front();
}

/// Returns whether a point of the hills, checked every centimetre, is in a shape.
template <class IsInside>
bool is_in_hills(const Pose& at, const IsInside& is_inside, const Heightmap& hills) {
  for (int i = -80; i <= 80; ++i)
    for (int j = -80; j <= 80; ++j) {
      const double x = at.position.x() + 0.01 * i, y = at.position.y() + 0.01 * j;
      const auto ground = hills.ground_at(x, y);
      if (ground && is_inside(at.inverse() * Vec3(x, y, ground->height))) return true;
    }
  return false;
}

TEST_F(OnRoughTerrain, EachShapeStandsAsLowAsItCan) {
  const BuiltScenario b = built(
      R"(    crate: {shape: {box: [1, 0.6, 0.4]}, place: {grid: {count: [4, 4], spacing: [3.1, 2.7], center: {yaw: 0.4, roll: 0.1}}}}
    ball: {shape: {sphere: 0.3}, place: {grid: {count: [4, 4], spacing: [2.3, 1.7]}}}
    tin: {shape: {cylinder: [0.2, 0.6]}, place: {grid: {count: [4, 4], spacing: [2.9, 3.1], center: {pitch: 0.3}}}})");
  const Heightmap hills = hills_.heightmap();
  const auto check = [&](const std::string& name, const auto& is_inside) {
    for (int i = 0; i < 16; ++i) {
      Pose at = pose(b, fmt::format("{}_{}", name, i));
      EXPECT_FALSE(is_in_hills(Pose{at.position + Vec3(0, 0, 1e-5), at.orientation}, is_inside, hills)) << name << i;
      at.position.z() -= 0.012;  // larger than the rise of the hills within a centimetre
      EXPECT_TRUE(is_in_hills(at, is_inside, hills)) << name << i << " hovers";
    }
  };
  check("crate", [](const Vec3& p) { return (p.cwiseAbs() - Vec3(0.5, 0.3, 0.2)).maxCoeff() < 0; });
  check("ball", [](const Vec3& p) { return p.norm() < 0.3; });
  check("tin", [](const Vec3& p) { return std::abs(p.z()) < 0.3 && std::hypot(p.x(), p.y()) < 0.2; });
}

class InAHollow : public OnTerrain {
 protected:
  InAHollow() : OnTerrain([](double x, double y) { return std::hypot(x, y) < 2 ? 0 : 6; }) {}
};

TEST_F(InAHollow, TheCameraOfARenderLooksOverTheRim) {
  folder_.file("s.yaml", scenario("", "robots: {ball: {shape: {sphere: 0.3}, mass: 1, motion: {use: motion.point}}}"));
  std::optional<FreeCamera> camera;
  const BuiltScenario b =
      build(read_scenario(folder_.path("s.yaml"), {}), test::plugins(),
            [&](Simulation& simulation) { camera.emplace(simulation, "camera", std::nullopt, std::nullopt); });
  camera->look(std::numeric_limits<double>::infinity());
  const Vec3 from = pose(b, "camera").position, to = pose(b, "ball/body").position;
  EXPECT_NEAR(from.x(), from.y(), 1e-9) << "it looks from where it looks in the plane";
  for (double part = 0; part <= 1; part += 0.01) {
    const Vec3 at = to + part * (from - to);
    EXPECT_GT(at.z(), hills_.heightmap().ground_at(at.x(), at.y())->height) << "at " << part;
  }
}

class OnGentleTerrain : public OnTerrain {
 protected:
  OnGentleTerrain() : OnTerrain([](double x, double y) { return 0.3 * std::sin(0.7 * x) * std::cos(0.5 * y); }) {}
};

TEST_F(OnGentleTerrain, ARobotIsHandedFromForcesToKinematicsAndBackWithoutAJump) {
  const BuiltScenario b = built("", R"(robots:
  rover:
    model: )" MURO_TEST_SOURCE_DIR R"(/examples/models/rover.urdf
    at: {x: 1, y: 1, yaw: 0.5}
    motion:
      levels: {near: {use: motion.simplified, rate: 1000}, far: {use: motion.differential_drive, rate: 1000}})");
  Simulation& s = *b.simulation;
  const ObjectId base = s.world().find_robot("rover")->base();
  const auto& now = s.world().value(base, keys::pose);
  const auto hand_over = [&](std::int32_t level) {
    const Pose before = now;
    s.world().value(base, keys::motion_level_target) = level;
    s.run_for(0.05);
    EXPECT_EQ(s.world().value(base, keys::motion_level), std::uint32_t(level));
    EXPECT_LT((now.position - before.position).norm(), 2e-3) << "to " << level;
    EXPECT_LT(now.orientation.angularDistance(before.orientation), 0.01) << "to " << level;
  };
  s.run_for(1);  // it falls onto all of its wheels
  hand_over(1);
  s.run_for(0.5);
  hand_over(0);
}

}  // namespace
}  // namespace muro::host
