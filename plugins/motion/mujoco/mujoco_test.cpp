// SPDX-License-Identifier: MIT
// Tests of motion.mujoco only. Tests for every motion are in tests/conformance.
#include <gtest/gtest.h>

#include <filesystem>

#include "plugins/common/mesh/files_testing.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace {

using namespace muro;
using test::block;
using test::solid_box;

constexpr double g = 9.81;

struct World : test::Scene {
  void start(std::map<std::string, ParameterInput> parameters = {}) {
    use("motion.mujoco", 1000, all_robots(), std::move(parameters));
    build();
  }
  Vec3 contact_force(const RobotView& r) { return world().value(r.base(), keys::contact_wrench).force; }
};

/// Returns the message of a scene that cannot be made.
std::string message_of(World& w) {
  try {
    w.start();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(MujocoMotion, WhatSlidesDoesNotLiftOff) {
  // MuJoCo alone lets a contact that slides at s separate at mu s: at 2 m/s the block would hop
  World w;
  w.add_ground(0.5);
  const RobotView& r =
      w.add("block", block(2, {0.2, 0.2, 0.1}, 0.5), {{0, 0, 0.05}, Quat::Identity()}, {{2, 0, 0}, Vec3::Zero()});
  w.start();
  w.run_for(0.05);
  for (int k = 0; k < 300; ++k) {
    w.run_for(0.001);
    EXPECT_NEAR(w.contact_force(r).z(), 2 * g, 0.02 * 2 * g) << "at " << k << " ms";
    EXPECT_NEAR(w.contact_force(r).x(), -0.5 * 2 * g, 0.02 * 2 * g) << "at " << k << " ms";
  }
}

TEST(MujocoMotion, MomentsThatNoSolidBodyHasAreTakenAsTheyAre) {
  // izz > ixx + iyy: MuJoCo's compiler refuses or changes such moments
  World w;
  w.world().set(world_object, keys::gravity, Vec3(Vec3::Zero()));
  const RobotView& r =
      w.add("odd", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 0.01, .iyy = 0.02, .izz = 0.1}));
  Wrench& push = w.push(r);
  w.start();
  push.torque = {0, 0, 0.3};
  w.run_for(1);
  EXPECT_NEAR(w.twist(r).angular.z(), 3, 1e-9);
}

TEST(MujocoMotion, AnErrorOfTheEngineEndsTheRunAndNotTheProcess) {
  World w;
  w.add_ground();
  const RobotView& r = w.add("block", block(2, {0.2, 0.2, 0.1}, 0.5), {{0, 0, 0.05}, Quat::Identity()});
  w.start();
  w.run_for(0.1);
  w.twist(r).linear.x() = std::nan("");
  EXPECT_THROW(w.run_for(0.1), std::exception);
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(MujocoMotion, TheArmatureOfAJointIsInertiaThatItFeels) {
  World w;
  w.world().set(world_object, keys::gravity, Vec3(Vec3::Zero()));
  w.add("r", test::tree_of([](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, solid_box(10, {1, 1, 0.1}));
          b.revolute("joint", Vec3::UnitZ(), {.armature = 0.3});
          b.body("link");
          b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.2, .iyy = 0.2, .izz = 0.2});
        }));
  w.start({{"joints", "effort"}, {"base", "fixed"}});
  w.world().value(w.world().object("r/joint"), keys::joint_effort_target) = 2;
  w.run_for(1);
  EXPECT_NEAR(w.world().value(w.world().object("r/joint"), keys::joint_velocity), 2 / (0.2 + 0.3), 1e-9);
}

TEST(MujocoMotion, MoreContactsThanExpectedGetMoreRoomAndLeaveNoFile) {
  // tables with 25 legs; each sole touches in 4 points
  const RobotTree table = test::tree_of([](RobotBuilder& b) {
    b.base("table");
    b.set(keys::inertial, solid_box(10, {1, 1, 0.1}));
    std::vector<Shape> legs;
    for (int i = 0; i < 25; ++i) {
      legs.push_back(Shape::box({0.05, 0.05, 0.2}));
      const int row = i / 5, column = i % 5;
      legs.back().origin.position = Vec3(0.2 * (column - 2), 0.2 * (row - 2), 0);
    }
    b.set_array(keys::collision_shapes, std::span<const Shape>(legs));
  });
  World w;
  w.add_ground();
  for (int i = 0; i < 3; ++i) w.add("t" + std::to_string(i), table, {{2.0 * i, 0, 0.1}, Quat::Identity()});
  w.start();
  w.run_for(0.5);
  for (const RobotView* r : w.world().robots()) EXPECT_NEAR(w.contact_force(*r).z(), 10 * g, 0.01 * 10 * g);
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(MujocoMotion, AModelThatMujocoRefusesIsAMessageWithItsTextAndTheRobot) {
  World w;
  w.add("mote", test::single_body(Shape::sphere(1e-3), {.mass = 1e-9, .ixx = 4e-16, .iyy = 4e-16, .izz = 4e-16}));
  const std::string message = message_of(w);
  EXPECT_NE(message.find("MuJoCo cannot make a model"), std::string::npos) << message;
  EXPECT_NE(message.find("mass and inertia of moving bodies must be larger"), std::string::npos) << message;
  EXPECT_NE(message.find("mote"), std::string::npos) << message;
}

TEST(MujocoMotion, NamesThatXmlWouldMisreadDoNoHarm) {
  World w;
  w.add("<a & 'b'>", block(1, {0.2, 0.2, 0.2}, 0.5));
  EXPECT_EQ(message_of(w), "");
}

TEST(MujocoMotion, MeshesCollideAsTheirConvexHulls) {
  const test::ScratchFolder folder;
  World w;
  w.add_ground();
  Shape shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  const std::string file =
      folder.file("box.stl", mesh::testing::stl_text(mesh::testing::box({-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3})));
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, solid_box(3, {0.2, 0.4, 0.6}));
    shape.mesh = b.intern(file);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
  const RobotView& r = w.add("mesh", tree, {{0, 0, 0.32}, Quat::Identity()});
  w.start();
  w.run_for(2);
  EXPECT_NEAR(w.pose(r).position.z(), 0.3, 1e-4);
  EXPECT_NEAR(w.contact_force(r).z(), 3 * g, 0.01 * 3 * g);
}

TEST(MujocoMotion, EverySolverFindsTheSame) {
  for (const char* solver : {"newton", "cg", "pgs"}) {
    World w;
    w.add_ground(0.5);
    const RobotView& r = w.add("block", block(2, {0.2, 0.2, 0.1}, 0.5), {{0, 0, 0.05}, Quat::Identity()});
    w.start({{"solver", std::string(solver)}, {"iterations", std::int64_t(1000)}});
    w.run_for(1);
    EXPECT_NEAR(w.contact_force(r).z(), 2 * g, 1e-2) << solver;
    EXPECT_NEAR(w.pose(r).position.z(), 0.05, 1e-4) << solver;
  }
}

}  // namespace
