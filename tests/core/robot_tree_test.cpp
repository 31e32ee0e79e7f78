// SPDX-License-Identifier: MIT
#include "core/robot_tree.hpp"

#include <gtest/gtest.h>

#include "core/world.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace muro {
namespace {

/// A cart with two wheels and a mast that carries a slider.
void build_cart(RobotBuilder& b) {
  b.base("cart");
  const Shape chassis = Shape::box({1, 0.5, 0.2});
  b.set_array(keys::collision_shapes, std::span<const Shape>(&chassis, 1));
  b.fork();
  b.translation({0, 0.3, -0.1});
  b.revolute("left_joint", {0, 2, 0}, {});
  b.body("left_wheel");
  b.end();
  b.fork();
  b.translation({0, -0.3, -0.1});
  b.revolute("right_joint", {0, 1, 0}, {});
  b.mimic("left_joint", -1, 0.5);
  b.body("right_wheel");
  const Shape wheel = Shape::sphere(0.2);
  b.set_array(keys::collision_shapes, std::span<const Shape>(&wheel, 1));
  b.end();
  b.translation({0, 0, 1});
  b.rotation(from_rpy(0, 0, M_PI / 2));
  b.body("mast");
  b.prismatic("slider", Vec3::UnitX(), {.lower = 0, .upper = 0.5});
  b.revolute("wrist", Vec3::UnitZ(), {});
  b.body("hand");
  b.end();
  b.end();
}

RobotTree cart() {
  RobotTree tree;
  build_cart(tree);
  tree.close();
  return tree;
}

TEST(RobotTree, KeepsThePapersBlocksInTheOrderOfBuilding) {
  const RobotTree tree = cart();
  ASSERT_TRUE(tree.usable());
  std::string kinds;
  for (const auto& n : tree.nodes()) kinds += "BFTRrpb"[static_cast<int>(n.kind)];
  EXPECT_EQ(kinds, "BFTrbFTrbTRbprb");
  EXPECT_EQ(tree.nodes()[5].parent, 1) << "the second fork hangs on the first";
}

TEST(RobotTree, FlattensToFramesWithFoldedTransforms) {
  World world;
  const RobotView& robot = world.add_robot("cart", cart());
  ASSERT_EQ(robot.links.size(), 6u);
  EXPECT_EQ(robot.links[1].parent, 0);
  EXPECT_EQ(robot.links[1].axis, Vec3::UnitY()) << "axes are normalised";
  EXPECT_EQ(robot.links[2].mimic, 1);
  EXPECT_EQ(robot.links[2].mimic_multiplier, -1);
  EXPECT_EQ(world.object_name(robot.links[3].object), "cart/mast");
  EXPECT_EQ(robot.links[3].joint, JointKind::fixed);
  EXPECT_EQ(world.object_name(robot.links[4].object), "cart/slider_frame")
      << "a joint without a body has a frame of its own";
  EXPECT_EQ(world.object_name(robot.links[5].object), "cart/hand");
  EXPECT_EQ(robot.links[5].parent, 4);
  // the mast is turned by 90 degrees: its x axis is the cart's y axis
  Pose p;
  for (const int i : {3, 4, 5}) p = p * pose_in_parent(robot.links[std::size_t(i)], i == 4 ? 0.5 : 0);
  EXPECT_LT((p.position - Vec3(0, 0.5, 1)).norm(), 1e-12);
}

TEST(RobotTree, KnowsHowItStandsAndHowWideItIs) {
  EXPECT_NEAR(cart().standing_height(), 0.3, 1e-12) << "the wheel's lowest point";
  EXPECT_NEAR(cart().footprint_radius(), std::hypot(0.5, 0.25), 1e-12);
}

TEST(RobotTree, StandsOnTheRimOfATiltedCylinderAndTheEndOfACapsule) {
  const auto height = [](const Shape& shape) {
    RobotTree b;
    b.base("body");
    b.rotation(from_rpy(0.5, 0, 0));
    b.body("link");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    b.close();
    return b.standing_height();
  };
  EXPECT_NEAR(height(Shape::cylinder(0.3, 0.4)), 0.3 * std::sin(0.5) + 0.2 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(height(Shape::capsule(0.3, 0.4)), 0.3 + 0.2 * std::cos(0.5), 1e-12);
}

TEST(RobotTree, MakesAnyNumberOfRobots) {
  World world;
  const RobotTree tree = cart();
  world.add_robot("a", tree);
  const RobotView& b = world.add_robot("b", tree, {{1, 2, 3}, Quat::Identity()});
  EXPECT_EQ(world.values(b.links[0].object, keys::collision_shapes)[0].size.x(), 1);
  EXPECT_EQ(world.value("b/cart", keys::initial_pose).position.z(), 3);
  EXPECT_EQ(world.robot_of(world.object("b/hand")), RobotId{1});
}

TEST(RobotTree, ForksAreBinary) {
  RobotTree tree;
  tree.base("base");
  tree.fork();
  tree.body("a");
  tree.end();
  tree.body("b");
  tree.end();
  tree.body("c");
  tree.close();
  ASSERT_EQ(tree.problems().size(), 1u);
  EXPECT_EQ(tree.problems()[0].text,
            "body() behind a fork whose two branches are closed: a fork is binary, open another in a branch");
}

TEST(RobotTree, CollectsEveryMisuse) {
  RobotTree tree;
  tree.body("early");
  tree.base("base");
  tree.base("again");
  tree.end();
  tree.revolute("j", Vec3::Zero(), {});
  tree.revolute("k", Vec3::UnitX(), {});
  tree.mimic("nobody", 1, 0);
  tree.body("base");
  tree.fork();
  tree.close();
  std::vector<std::string> texts;
  for (const auto& p : tree.problems()) texts.push_back(p.text);
  EXPECT_EQ(texts,
            (std::vector<std::string>{
                "body() before base(): a robot's tree begins with its base", "a second base `again`; a robot has one",
                "end() without a fork() that is open", "joint `j`: the axis has no direction",
                "two parts are named `base`; names of bodies and joints are unique in a robot",
                "1 fork() without two end()", "joint `k` mimics `nobody`, which is no joint of the robot"}));
  EXPECT_FALSE(tree.usable());
}

}  // namespace
}  // namespace muro
