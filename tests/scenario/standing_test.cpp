// SPDX-License-Identifier: MIT
// Bodies without a given height stand on the ground at any orientation: shapes compared with points on their surfaces.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "host/scenario/builder.hpp"
#include "muro/base/random.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/support/hills.hpp"

namespace muro::host {
namespace {

constexpr double micrometre = 1e-6;  ///< m
constexpr int copies = 8;            ///< of each kind, each turned at random

/// A kind of shape, and points on its surface: a plane that touches the shape touches a point, to a micrometre.
struct Form {
  std::string name, yaml;
  std::vector<Vec3> points;
};

void add_rim(std::vector<Vec3>& points, double radius, double z) {
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i)
    points.emplace_back(radius * std::cos(2 * M_PI * i / count), radius * std::sin(2 * M_PI * i / count), z);
}

/// Returns the radius of shapes of balls, whose points are centres of balls; 0 for others.
double ball_radius(const std::string& name) { return name == "ball" ? 0.3 : name == "pole" ? 0.15 : 0; }

class Standing : public testing::Test {
 protected:
  Standing() {
    forms_.push_back(
        {"box", "{box: [0.2, 0.4, 0.1]}", mesh::testing::box({-0.1, -0.2, -0.05}, {0.1, 0.2, 0.05}).vertices});
    forms_.push_back({"ball", "{sphere: 0.3}", {Vec3::Zero()}});
    forms_.push_back({"pole", "{capsule: [0.15, 0.5]}", {{0, 0, 0.25}, {0, 0, -0.25}}});
    Form tin{"tin", "{cylinder: [0.25, 0.1]}", {}};
    for (const double z : {0.05, -0.05}) add_rim(tin.points, 0.25, z);
    forms_.push_back(tin);
    // a gutter is concave; an egg has more corners than a person can check
    mesh::Mesh gutter, egg;
    gutter.vertices = {{-1, -1, 1}, {-1, 1, 1}, {0, -1, 0},   {0, 1, 0},
                       {1, -1, 1},  {1, 1, 1},  {0, -1, 0.2}, {0, 1, 0.2}};
    gutter.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {0, 1, 7}, {0, 7, 6},
                        {6, 7, 5}, {6, 5, 4}, {0, 6, 2}, {2, 6, 4}, {1, 3, 7}, {3, 5, 7}};
    constexpr int around = 24, along = 10;
    for (int i = 0; i < along; ++i)
      for (int k = 0; k < around; ++k) {
        const double a = M_PI * (i + 0.5) / along, b = 2 * M_PI * k / around;
        egg.vertices.emplace_back(0.2 * std::sin(a) * std::cos(b), 0.25 * std::sin(a) * std::sin(b), 0.3 * std::cos(a));
      }
    for (Vec3& p : egg.vertices) p = (p * 1e4).array().round() / 1e4;  // its file has six digits
    const auto node = [](int i, int k) { return std::uint32_t(i * around + k % around); };
    for (int i = 0; i + 1 < along; ++i)
      for (int k = 0; k < around; ++k) {
        egg.triangles.push_back({node(i, k), node(i + 1, k), node(i + 1, k + 1)});
        egg.triangles.push_back({node(i, k), node(i + 1, k + 1), node(i, k + 1)});
      }
    folder_.file("gutter.obj", mesh::testing::obj_text(gutter));
    folder_.file("egg.obj", mesh::testing::obj_text(egg));
    forms_.push_back({"gutter", "{mesh: gutter.obj, scale: [0.3, -0.2, 0.4]}", gutter.vertices});
    for (Vec3& p : forms_.back().points) p = p.cwiseProduct(Vec3(0.3, -0.2, 0.4));
    forms_.push_back({"egg", "{mesh: egg.obj}", egg.vertices});
  }

  /// Returns all kinds as scenery and as robots, turned at random, without heights.
  std::string everything() const {
    std::string objects, robots;
    int number = 0;
    for (const Form& k : forms_) {
      std::string list;
      for (int i = 0; i < copies; ++i, ++number) {
        const Random random(3, std::uint64_t(number), 0);
        const double x = -8 + 16 * random.uniform(0), y = -8 + 16 * random.uniform(1);
        list += fmt::format("{{x: {}, y: {}, roll: {}, pitch: {}, yaw: {}}}, ", x, y, 6 * random.uniform(2),
                            6 * random.uniform(3), 6 * random.uniform(4));
      }
      objects += fmt::format("    {}: {{shape: {}, place: {{list: [{}]}}}}\n", k.name, k.yaml, list);
      robots += fmt::format("  r_{}: {{shape: {}, mass: 1, count: {}, place: {{list: [{}]}}}}\n", k.name, k.yaml,
                            copies, list);
    }
    return objects + "robots:\n" + robots;
  }

  BuiltScenario built(const std::string& text) {
    return build(read_scenario(folder_.file("s.yaml", text), {}), test::plugins());
  }

  /// `above`: height of a point (m), along the normal of the ground below it.
  void expect_on_ground(const std::string& ground, const std::function<double(const Vec3&)>& above) {
    const BuiltScenario b = built("world:\n  objects:\n" + ground + everything());
    const World& world = b.simulation->world();
    for (const Form& k : forms_)
      for (int i = 0; i < copies; ++i)
        for (const std::string& name : {fmt::format("{}_{}", k.name, i), fmt::format("r_{}_{}/body", k.name, i)}) {
          const Pose pose = world.value(world.object(name), keys::pose);
          double lowest = std::numeric_limits<double>::infinity();
          for (const Vec3& p : k.points) lowest = std::min(lowest, above(pose * p) - ball_radius(k.name));
          EXPECT_NEAR(lowest, 0, micrometre) << name << " on " << ground;
        }
  }

  test::ScratchFolder folder_;
  std::vector<Form> forms_;
};

TEST_F(Standing, OnZeroWhereThereIsNoGround) {
  expect_on_ground("", [](const Vec3& p) { return p.z(); });
}

TEST_F(Standing, OnAPlaneThatIsHigher) {
  expect_on_ground("    ground: {shape: plane, at: {z: 0.7}}\n", [](const Vec3& p) { return p.z() - 0.7; });
}

TEST_F(Standing, OnAPlaneThatIsInclined) {
  const Pose plane{{1, 2, -0.5}, from_rpy(0.2, -0.4, 0)};
  expect_on_ground("    ground: {shape: plane, at: {x: 1, y: 2, z: -0.5, roll: 0.2, pitch: -0.4}}\n",
                   [&](const Vec3& p) { return (plane.inverse() * p).z(); });
}

TEST_F(Standing, OnAHeightmapAndThePlaneBelow) {
  const test::Hills hills(32, 64, [](double x, double y) { return 0.25 * x - 0.125 * y; });
  const Vec3 normal = Vec3(-0.25, 0.125, 1).normalized();
  expect_on_ground(fmt::format("    ground: {{shape: plane, at: {{z: -9}}}}\n"
                               "    hills: {{shape: {{heightmap: {}, size: [32, 32, 1]}}}}\n",
                               hills.path()),
                   [&](const Vec3& p) { return normal.dot(p); });
}

TEST_F(Standing, OnThePlaneBesideAHeightmap) {
  const test::Hills hills(1, 2, [](double, double) { return 0.0; });
  expect_on_ground(fmt::format("    ground: {{shape: plane}}\n"
                               "    hills: {{shape: {{heightmap: {}, size: [1, 1, 1]}}, at: {{x: 40}}}}\n",
                               hills.path()),
                   [](const Vec3& p) { return p.z(); });
}

TEST_F(Standing, OnABoxThatIsAFloor) {
  expect_on_ground("    floor: {shape: {box: [20, 20, 0.3]}}\n", [](const Vec3& p) { return p.z() - 0.3; });
  expect_on_ground("    floor: {shape: {box: [20, 20, 0.3]}, at: {z: -2}}\n",
                   [](const Vec3& p) { return p.z() + 1.85; });
  const Pose ramp{{0, 0, 4}, from_rpy(0.3, -0.2, 0)};
  expect_on_ground("    floor: {shape: {box: [40, 40, 0.4]}, at: {z: 4, roll: 0.3, pitch: -0.2}}\n",
                   [&](const Vec3& p) { return (ramp.inverse() * p).z() - 0.2; });
}

TEST_F(Standing, BelowARoofAndBesideAWallAndOnAStep) {
  const BuiltScenario b = built(R"(
world:
  objects:
    ground: {shape: plane}
    roof: {shape: {box: [4, 4, 0.1]}, at: {z: 2}}
    wall: {shape: {box: [0.1, 4, 4]}, at: {x: 6}}
    step: {shape: {box: [2, 2, 0.1]}, at: {y: 6}}
    upper: {shape: {box: [1, 1, 0.1]}, at: {y: 6}}
    crate: {shape: {box: [1, 1, 1]}}
robots:
  low: {shape: {box: [1, 1, 1]}, mass: 1, at: {x: 1}}
  high: {shape: {box: [1, 1, 2.5]}, mass: 1, at: {x: -1}}
  beside: {shape: {box: [1, 1, 1]}, mass: 1, at: {x: 6}}
  part: {shape: {sphere: 0.5}, mass: 1, at: {x: 1.3, y: 6}}
  upstairs: {shape: {sphere: 0.5}, mass: 1, at: {y: 6}}
)");
  const World& world = b.simulation->world();
  const auto height = [&](const char* name) { return world.value(world.object(name), keys::pose).position.z(); };
  EXPECT_NEAR(height("crate"), 0.5, micrometre);
  EXPECT_NEAR(height("low/body"), 0.5, micrometre) << "below the roof";
  EXPECT_NEAR(height("high/body"), 2.05 + 1.25, micrometre) << "it does not fit below the roof";
  EXPECT_NEAR(height("beside/body"), 0.5, micrometre) << "a wall is no floor";
  EXPECT_NEAR(height("upper"), 0.15, micrometre) << "on the step";
  EXPECT_NEAR(height("upstairs/body"), 0.7, micrometre);
  EXPECT_NEAR(height("part/body"), 0.1 + std::sqrt(0.25 - 0.09), micrometre) << "on the edge of the step";
}

TEST_F(Standing, ARobotWithItsJointsWhereTheyStart) {
  const Random random(5, 1, 0);
  for (int i = 0; i < 6; ++i) {
    const auto angle = [&](int k) { return -1 + 2 * random.uniform(std::uint64_t(10 * i + k)); };
    const BuiltScenario b = built(fmt::format(
        "world: {{objects: {{ground: {{shape: plane}}}}}}\nrobots:\n  arm: {{model: {}/examples/models/arm.urdf, "
        "joints: {{turn: {}, shoulder: {}, elbow: {}, wrist: {}}}, at: {{roll: {}, pitch: {}}}}}\n",
        MURO_TEST_SOURCE_DIR, angle(0), 0.5 * angle(1), 0.5 * angle(2), angle(3), 3 * angle(4), 3 * angle(5)));
    const World& world = b.simulation->world();
    const RobotView& arm = *world.robots()[0];
    std::vector<Pose> poses{world.value(arm.base(), keys::pose)};
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < arm.links.size(); ++l) {
      const Link& link = arm.links[l];
      const auto start = [&](const Link& of) {
        const ArrayHeader given = world.store().constant(of.joint_object, keys::initial_joint_position);
        return given.data ? *static_cast<const double*>(given.data) : 0;
      };
      double q = 0;
      if (link.joint != JointKind::fixed)
        q = link.mimic < 0 ? start(link)
                           : link.mimic_offset + link.mimic_multiplier * start(arm.links[std::size_t(link.mimic)]);
      if (l > 0) poses.push_back(poses[std::size_t(link.parent)] * pose_in_parent(link, q));
      const ArrayHeader shapes = world.store().constant(link.object, keys::collision_shapes);
      for (std::size_t k = 0; k < shapes.size; ++k) {
        const Shape& s = static_cast<const Shape*>(shapes.data)[k];
        std::vector<Vec3> points;
        if (s.kind == ShapeKind::cylinder)
          for (const double z : {0.5 * s.size.z(), -0.5 * s.size.z()}) add_rim(points, s.size.x(), z);
        else if (s.kind == ShapeKind::box)
          points = mesh::testing::box(-0.5 * s.size, 0.5 * s.size).vertices;
        else
          ADD_FAILURE() << "a kind of shape that this test does not know";
        for (const Vec3& p : points) lowest = std::min(lowest, (poses[l] * (s.origin * p)).z());
      }
    }
    EXPECT_NEAR(lowest, 0, micrometre) << i;
  }
}

TEST_F(Standing, AHeightThatIsGivenStaysAndOverlapIsToldWithItsPlace) {
  const BuiltScenario b = built(R"(world: {objects: {ground: {shape: plane}}}
robots:
  tilted: {shape: {box: [0.2, 0.2, 0.1]}, mass: 1, at: {pitch: 0.5, z: 0.05}, motion: {use: motion.simplified}}
  told_nothing: {shape: {box: [0.2, 0.2, 0.1]}, mass: 1, at: {x: 3, pitch: 0.5}, motion: {use: motion.simplified}}
)");
  EXPECT_EQ(b.simulation->world().value(b.simulation->world().object("tilted/body"), keys::pose).position.z(), 0.05);
  ASSERT_EQ(b.notes.size(), 1u);
  EXPECT_NE(b.notes[0].find("s.yaml:3:56: note: `tilted/body` and `ground` overlap by 0.042 m at the start"),
            std::string::npos)
      << b.notes[0];
}

}  // namespace
}  // namespace muro::host
