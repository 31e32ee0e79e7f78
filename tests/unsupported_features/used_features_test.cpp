// SPDX-License-Identifier: MIT
// Features that a robot uses of its motion, found from its model and its parameters.
#include "host/scenario/features/used_features.hpp"

#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"

namespace muro::host {
namespace {

const Inertia solid{.mass = 1, .ixx = 0.1, .iyy = 0.1, .izz = 0.1};

/// Returns a base that carries a wheel (balanced), an arm (not balanced), and a slide that follows the arm.
RobotTree machine() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, solid);
    b.fork();
    b.revolute("axle", Vec3::UnitY(), {.velocity = 40, .effort = 2, .damping = 0.1});
    b.body("wheel");
    b.set(keys::inertial, Inertia{.mass = 0.5, .ixx = 0.01, .iyy = 0.02, .izz = 0.01});
    b.end();
    b.fork();
    b.revolute("shoulder", Vec3::UnitY(), {.lower = -1, .upper = 1, .friction = 0.2});
    b.body("arm");
    b.set(keys::inertial, Inertia{.mass = 0.5, .com = Vec3(0.3, 0, 0), .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
    b.end();
    b.prismatic("slide", Vec3::UnitX(), {.lower = 0, .upper = 1});
    b.mimic("shoulder", 0.1, 0);
    b.body("tongue");
    b.end();
    b.end();
  });
}

std::map<Features, std::string> features_of(const World& world, const RobotView& robot,
                                            const std::map<std::string, ParameterInput>& parameters = {},
                                            bool own_contacts = false, bool contacts = true) {
  std::map<Features, std::string> all;
  for (const UsedFeature& f : used_features(world, scenery_traits(world), robot, {parameters, own_contacts, contacts}))
    all[f.bit] = f.amount;
  return all;
}

TEST(UsedFeatures, JointsUseWhatTheirModelStates) {
  test::Scene s;
  const RobotView& robot = s.add("machine", machine());
  const auto all = features_of(s.world(), robot);
  EXPECT_EQ(all.at(feature_joints), "2 joints") << "the one that follows another is no motion of its own";
  EXPECT_EQ(all.at(feature_joint_limits), "1 joint");
  EXPECT_EQ(all.at(feature_joint_speed_limits), "1 joint");
  EXPECT_EQ(all.at(feature_joint_effort_limits), "1 joint");
  EXPECT_EQ(all.at(feature_joint_damping), "1 joint");
  EXPECT_EQ(all.at(feature_joint_friction), "1 joint");
  EXPECT_EQ(all.count(feature_velocity_targets), 0u) << "nothing writes any";
  EXPECT_EQ(all.count(feature_contact), 0u) << "it has no shapes";
}

TEST(UsedFeatures, AWheelMovesNoMassAndAnArmDoes) {
  test::Scene s;
  const auto all = features_of(s.world(), s.add("machine", machine()));
  EXPECT_EQ(all.at(feature_link_dynamics), "1 joint");
  EXPECT_EQ(
      features_of(s.world(), *s.world().robots()[0], {{"base", std::string("fixed")}}).count(feature_link_dynamics), 0u)
      << "one alone has nothing to push";
}

TEST(UsedFeatures, MassAndShapesUseForcesAndContact) {
  test::Scene s;
  Shape ball = Shape::sphere(0.1);
  const RobotView& smooth = s.add("smooth", test::single_body(ball, solid));
  ball.surface.restitution = 0.5;
  const RobotView& elastic = s.add("elastic", test::single_body(ball, solid));
  ball.kind = ShapeKind::mesh;
  ball.size = {1, 1, 1};
  const RobotView& mesh = s.add("mesh", test::single_body(ball, solid));
  const auto all = features_of(s.world(), smooth);
  EXPECT_EQ(all.count(feature_forces) + all.count(feature_contact) + all.count(feature_friction), 3u);
  EXPECT_EQ(all.count(feature_restitution) + all.count(feature_gyroscopic), 0u) << "a ball spins steadily";
  EXPECT_EQ(features_of(s.world(), elastic).count(feature_restitution), 1u);
  EXPECT_EQ(features_of(s.world(), mesh).count(feature_convex_meshes), 0u)
      << "collision detection tells what it cannot do";
  EXPECT_EQ(features_of(s.world(), mesh, {}, true).at(feature_convex_meshes), "1 of its own");
  EXPECT_EQ(features_of(s.world(), mesh, {}, false, false).count(feature_contact), 0u) << "contact is switched off";
}

TEST(UsedFeatures, HeightmapsAreUsedByMotionsThatFindContactsThemselves) {
  test::Scene s;
  const Shape hills{.kind = ShapeKind::heightmap, .size = {8, 8, 1}};
  s.world().add_scenery("hills", {}, std::span<const Shape>(&hills, 1));
  const RobotView& ball = s.add("ball", test::single_body(Shape::sphere(0.1), solid));
  EXPECT_EQ(features_of(s.world(), ball, {}, true).at(feature_heightmaps), "1 heightmap");
  EXPECT_EQ(features_of(s.world(), ball).count(feature_heightmaps), 0u) << "collision detection has them";
}

TEST(UsedFeatures, ParametersSayWhetherTheBaseIsFixedAndLinksMeet) {
  test::Scene s;
  const RobotView& robot = s.add("machine", machine());
  EXPECT_EQ(features_of(s.world(), robot).count(feature_gyroscopic), 1u);
  const auto all = features_of(s.world(), robot, {{"base", std::string("fixed")}, {"self_collision", true}});
  EXPECT_EQ(all.count(feature_fixed_base) + all.count(feature_self_collision), 2u);
  EXPECT_EQ(all.count(feature_gyroscopic), 0u) << "its base turns no more";
}

}  // namespace
}  // namespace muro::host
