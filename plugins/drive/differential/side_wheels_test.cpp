// SPDX-License-Identifier: MIT
// Search for wheels, tested through a drive: the speeds that a command asks of the wheels show which wheels were found,
// on which side, with which radius, track and sense of rotation.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

struct Found : test::Scene {
  explicit Found(const RobotTree& tree, Settings settings = {}) {
    const RobotView& robot = add("rover", tree);
    use("drive.differential", 100, all_robots(), std::move(settings));
    build();
    base_ = robot.base();
  }
  bool has(const std::string& wheel) {
    const ObjectId joint = world().object("rover/" + wheel + "_joint");
    return world().store().find(joint, keys::joint_velocity_target.name) != nullptr;
  }
  /// Returns rad/s of the wheel at 1 m/s.
  double forward(const std::string& wheel) { return asked(wheel, {{1, 0, 0}, {0, 0, 0}}); }
  /// Returns rad/s of the wheel at 1 rad/s.
  double turn(const std::string& wheel) { return asked(wheel, {{0, 0, 0}, {0, 0, 1}}); }

 private:
  double asked(const std::string& wheel, const Twist& command) {
    world().value(base_, keys::command_twist) = command;
    run_for(0.01);
    return world().value("rover/" + wheel + "_joint", keys::joint_velocity_target);
  }
  ObjectId base_{};
};

/// Returns the message that the user reads when the wheels cannot be found.
std::string complaint(const RobotTree& tree, const Settings& settings = {}) {
  return test::complaint_of([&] { Found found(tree, settings); });
}

std::vector<WheelPart> pair() { return {{.name = "left", .at = {0, 0.2, 0}}, {.name = "right", .at = {0, -0.2, 0}}}; }

std::vector<WheelPart> pair_and(const WheelPart& more) {
  std::vector<WheelPart> all = pair();
  all.push_back(more);
  return all;
}

TEST(SideWheels, AreThoseOfARoverWithFourWheels) {
  std::vector<WheelPart> four;
  for (const double x : {0.12, -0.12})
    for (const double y : {0.15, -0.15})
      four.push_back({.name = std::string(x > 0 ? "front_" : "rear_") + (y > 0 ? "left" : "right"),
                      .at = {x, y, -0.03},
                      .radius = 0.06,
                      .limits = {.velocity = 40}});
  Found found(test::wheeled_robot(four));
  for (const std::string end : {"front_", "rear_"}) {
    EXPECT_NEAR(found.forward(end + "left"), 1 / 0.06, 1e-12);
    EXPECT_NEAR(found.turn(end + "left"), -0.15 / 0.06, 1e-12);
    EXPECT_NEAR(found.turn(end + "right"), 0.15 / 0.06, 1e-12);
  }
}

TEST(SideWheels, TurnBackwardAboutAnAxisThatPointsRight) {
  std::vector<WheelPart> wheels = pair();
  wheels[1].axis = -Vec3::UnitY();
  Found found(test::wheeled_robot(wheels));
  EXPECT_NEAR(found.forward("left"), 20, 1e-12);
  EXPECT_NEAR(found.forward("right"), -20, 1e-12);
  EXPECT_NEAR(found.turn("right"), -4, 1e-12);
}

TEST(SideWheels, MayBeSpheresAndMayOnlyBeSeen) {
  std::vector<WheelPart> wheels = pair();
  for (WheelPart& w : wheels) {
    w.own_shape = true;
    w.shape = Shape::sphere(0.1);
    w.visual = true;
  }
  Found found(test::wheeled_robot(wheels));
  EXPECT_NEAR(found.forward("left"), 10, 1e-12);
}

TEST(SideWheels, StandWhereTheirShapesAre) {
  std::vector<WheelPart> wheels = pair();
  for (WheelPart& w : wheels) {
    w.own_shape = true;
    w.shape = test::tyre(0.05);
    w.shape.origin.position.y() = w.at.y() > 0 ? 0.1 : -0.1;
  }
  Found found(test::wheeled_robot(wheels));
  EXPECT_NEAR(found.turn("right"), 0.3 / 0.05, 1e-12) << "track 0.6 m";
}

TEST(SideWheels, HaveEachTheirOwnRadius) {
  std::vector<WheelPart> wheels = pair();
  wheels[0].radius = 0.1;
  Found found(test::wheeled_robot(wheels));
  EXPECT_NEAR(found.forward("left"), 10, 1e-12);
  EXPECT_NEAR(found.forward("right"), 20, 1e-12);
}

TEST(SideWheels, AreFoundBehindARotatedFrameAndOnAFixedChild) {
  const Shape tyre = test::tyre(0.08);
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    b.fork();
    b.translation({0, 0.3, 0});
    b.rotation(from_rpy(-M_PI / 2, 0, 0));  // z of the joint is y of the base, as CAD programs export wheels
    b.revolute("left_joint", Vec3::UnitZ(), {});
    b.body("left_wheel");
    const Shape flat = Shape::cylinder(0.08, 0.03);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&flat, 1));
    b.end();
    b.translation({0, -0.3, 0});
    b.revolute("right_joint", Vec3::UnitY(), {});
    b.body("right_hub");
    b.translation({0, -0.02, 0});
    b.body("right_tyre");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
    b.end();
  });
  Found found(tree);
  EXPECT_NEAR(found.forward("left"), 12.5, 1e-12);
  EXPECT_NEAR(found.turn("right"), 0.32 / 0.08, 1e-12);
  EXPECT_NEAR(found.turn("left"), -0.3 / 0.08, 1e-12);
}

TEST(SideWheels, AreNotDiscsArmsOrJointsOfOtherDirections) {
  const auto with = [](const WheelPart& part) { return Found(test::wheeled_robot(pair_and(part))).has(part.name); };
  WheelPart arm{.name = "other", .at = {0, 0.5, 0}, .own_shape = true};
  arm.shape = test::tyre(0.05);
  arm.shape.origin.position.x() = 0.3;
  EXPECT_TRUE(with({.name = "other", .at = {0, 0.5, 0}}));
  EXPECT_FALSE(with({.name = "other", .at = {0, 0.5, 0}, .limits = {.lower = -1, .upper = 1}}));
  EXPECT_FALSE(with({.name = "other", .at = {0, 0.5, 0}, .axis = Vec3::UnitZ()}));
  EXPECT_FALSE(with({.name = "other", .at = {0, 0.5, 0}, .axis = {0, 1, 1}}));
  EXPECT_FALSE(with({.name = "other", .at = {0, 0, 0}})) << "neither left nor right";
  EXPECT_FALSE(with({.name = "other", .at = {0, 0.5, 0}, .shape = Shape::box({1, 1, 1}), .own_shape = true}));
  EXPECT_FALSE(with(arm));
}

TEST(SideWheels, AreNotCastersNorFollowers) {
  const Shape tyre = test::tyre(0.02);
  const RobotTree tree = test::wheeled_robot(pair(), [&](RobotBuilder& b) {
    b.fork();
    b.translation({-0.3, 0.1, 0});
    b.revolute("swivel_joint", Vec3::UnitZ(), {});
    b.body("fork");
    b.revolute("caster_joint", Vec3::UnitY(), {});
    b.body("caster_wheel");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
    b.end();
    b.translation({-0.3, 0.1, 0});
    b.revolute("follower_joint", Vec3::UnitY(), {});
    b.mimic("left_joint", 1, 0);
    b.body("follower_wheel");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
    b.end();
  });
  Found found(tree);
  EXPECT_TRUE(found.has("left"));
  EXPECT_FALSE(found.has("caster"));
  EXPECT_FALSE(found.has("follower"));
}

TEST(SideWheels, MayHangOnASpringOrARocker) {
  const Shape tyre = test::tyre(0.1);
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    b.fork();
    b.translation({0, 0.3, 0});
    b.prismatic("spring", Vec3::UnitZ(), {.lower = -0.1, .upper = 0.1});
    b.body("strut");
    b.revolute("left_joint", Vec3::UnitY(), {});
    b.body("left_wheel");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
    b.end();
    b.translation({0, -0.3, 0});
    b.revolute("rocker", Vec3::UnitY(), {.lower = -0.3, .upper = 0.3});
    b.body("bogie");
    b.revolute("right_joint", Vec3::UnitY(), {});
    b.body("right_wheel");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
    b.end();
  });
  EXPECT_NEAR(Found(tree).turn("right"), 3, 1e-12);
}

TEST(SideWheels, CanBeNamedByTheUser) {
  std::vector<WheelPart> wheels = pair_and({.name = "spare", .at = {0, 0.5, 0}});
  for (WheelPart& w : wheels) {
    w.own_shape = true;
    w.shape = Shape::box({1, 1, 1});
  }
  Found found(test::wheeled_robot(wheels),
              {{"left", Names{"left_joint"}}, {"right", Names{"right_joint"}}, {"wheel_radius", 0.2}});
  EXPECT_FALSE(found.has("spare"));
  EXPECT_NEAR(found.forward("left"), 5, 1e-12);
  EXPECT_NEAR(found.turn("left"), -1, 1e-12);
}

TEST(SideWheels, AModelWithoutWheelsIsAnErrorThatTellsWhatItHas) {
  EXPECT_SAYS(complaint(test::single_body(Shape::sphere(1), {.mass = 1})),
              "`rover` has no driven wheels on either side: no joint of it turns. Name the wheels' joints with `left` "
              "and `right`");
  const RobotTree odd =
      test::wheeled_robot({{.name = "a", .at = {0, 1, 0}, .limits = {.lower = -1, .upper = 1}},
                           {.name = "b", .at = {0, 1, 0}, .axis = Vec3::UnitZ()},
                           {.name = "c", .at = {0, 1, 0}, .shape = Shape::box({1, 1, 1}), .own_shape = true}});
  const std::string text = complaint(odd);
  EXPECT_SAYS(text, "; 1 joint has limits of position. Name");
  EXPECT_SAYS(text, "`b_joint` turns about (0.000, 0.000, 1.000), not the y axis, of the base");
  EXPECT_SAYS(text, "`c_joint` has no cylinder or sphere about its axis as a shape");
}

TEST(SideWheels, OnOneSideAloneAreAnError) {
  EXPECT_SAYS(complaint(test::wheeled_robot({{.name = "left", .at = {0, 0.2, 0}}})),
              "`rover` has no driven wheels on the right (y < 0): `left_joint` is on the left.");
}

TEST(SideWheels, WrongNamesAreErrorsWithTheRightOnes) {
  const RobotTree tree = test::wheeled_robot(pair());
  const auto named = [&](Names left, Names right) {
    Settings s;
    if (!left.empty()) s["left"] = left;
    if (!right.empty()) s["right"] = right;
    return complaint(tree, s);
  };
  EXPECT_SAYS(named({"lft"}, {"right_joint"}),
              "`rover` has no joint `lft`; its joints are: `left_joint` `right_joint`");
  EXPECT_SAYS(named({"left_joint"}, {}),
              "`left` names wheels, but `right` does not; name the wheels of both sides or of none");
  EXPECT_SAYS(named({"right_joint"}, {"left_joint"}), "the wheels of `left` lie on the right of those of `right`");
  EXPECT_SAYS(named({"left_joint"}, {"left_joint"}), "name the same wheel");
}

TEST(SideWheels, NamedJointsMustBeAbleToRoll) {
  const Settings names{{"left", Names{"left_joint"}}, {"right", Names{"right_joint"}}};
  const auto with = [&](const WheelPart& left) {
    return complaint(test::wheeled_robot({left, {.name = "right", .at = {0, -0.2, 0}}}), names);
  };
  EXPECT_SAYS(with({.name = "left", .at = {0, 0.2, 0}, .axis = Vec3::UnitX()}),
              "joint `left_joint` cannot drive a wheel: it turns about (1.000, 0.000, 0.000)");
  EXPECT_SAYS(with({.name = "left", .at = {0, 0.2, 0}, .limits = {.lower = 0, .upper = 1}}),
              "joint `left_joint` cannot drive a wheel: it has limits of position");
  EXPECT_SAYS(with({.name = "left", .at = {0, 0.2, 0}, .shape = Shape::box({1, 1, 1}), .own_shape = true}),
              "the wheel of joint `left_joint` has no cylinder or sphere about its axis; give `wheel_radius`");
}

}  // namespace
}  // namespace muro
