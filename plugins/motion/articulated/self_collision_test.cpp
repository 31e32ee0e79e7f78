// SPDX-License-Identifier: MIT
// Links of one robot that touch each other: the place where an arm comes to rest on its trunk, by geometry and by
// MuJoCo; momenta in flight; light arms; the cost without `self_collision`.
#include "articulated_testing.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/randoms.hpp"

namespace muro::articulated::testing {
namespace {

/// Returns a trunk of 0.3 m with arms at its sides, 0.15 m from it. The forearm, of `kilograms`, ends in a ball, 0.25 m
/// from the elbow and with a radius of 0.03 m.
RobotTree robot_with_arms(double kilograms, bool both = false) {
  const Shape trunk = test::with(Shape::box({0.3, 0.3, 0.8}), 0.5), hand = test::with(Shape::sphere(0.03), 0.5);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, test::solid_box(10, {0.3, 0.3, 0.8}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&trunk, 1));
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && !both) break;
      const std::string name = side > 0 ? "right" : "left";
      if (both && side > 0) b.fork();
      b.translation({0.3 * side, 0, 0.2});
      b.revolute(name + "_shoulder", side * Vec3::UnitY(), {.lower = -2, .upper = 2, .effort = 50});
      b.body(name + "_upper_arm");
      b.set(keys::inertial, Inertia{.mass = kilograms, .com = {0, 0, -0.1}, .ixx = 4e-3, .iyy = 4e-3, .izz = 1e-3});
      b.translation({0, 0, -0.2});
      b.revolute(name + "_elbow", side * Vec3::UnitY(), {.lower = -2, .upper = 2, .effort = 20});
      b.body(name + "_forearm");
      const double i = kilograms * 0.25 * 0.25 / 3;
      b.set(keys::inertial, Inertia::from(kilograms, {0, 0, -0.125}, Vec3(i / 4, i / 4, i / 40).asDiagonal()));
      Shape ball = hand;
      ball.origin.position = Vec3(0, 0, -0.25);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
      if (both) b.end();
    }
  });
}
const double touching = std::asin(0.12 / 0.25);  ///< rad: angle of the elbow at which the ball touches the trunk

Parameters with_self_collision(const std::string& base, double frequency = 50) {
  return {{"joints", std::string("position")}, {"base", base}, {"self_collision", true}, {"frequency", frequency}};
}

TEST(AnArm, ComesToRestOnTheTrunkWhereGeometryAndMujocoSay) {
  double elbow[2] = {};
  for (const bool by_mujoco : {false, true}) {
    World w;
    const RobotView& r = w.add("r", robot_with_arms(1));
    Parameters p = with_self_collision("fixed");
    p["velocity_joints"] = std::vector<std::string>{"right_shoulder"};  // this joint does not give way
    if (by_mujoco) {
      p.erase("frequency");
      w.use("motion.mujoco", 1000, w.all_robots(), p);
      w.use_kinematics();
      w.build();
    } else {
      w.start(p);
    }
    w.of("r/right_elbow", keys::joint_position_target) = 0.6;
    w.run_for(2);
    EXPECT_LT(std::abs(w.v("r/right_elbow")), 1e-3) << "rad/s: it rests";
    elbow[by_mujoco] = w.q("r/right_elbow");
    RecordProperty(by_mujoco ? "mujoco" : "articulated", std::to_string(elbow[by_mujoco] - touching));
    if (!by_mujoco) {
      EXPECT_LT(w.contact_force(r).norm(), 1e-9) << "N: of both links together";
      EXPECT_GT(w.world().value(r.base(), keys::contact_wrench).force.norm(), 1) << "N";
    }
  }
  EXPECT_GT(elbow[0], touching) << "it presses";
  EXPECT_NEAR(elbow[0], touching, 0.005);
  EXPECT_NEAR(elbow[0], elbow[1], 0.005);
}

TEST(AnArm, PassesThroughTheTrunkWithoutSelfCollision) {
  World w;
  const RobotView& r = w.add("r", robot_with_arms(1));
  Parameters p = with_self_collision("fixed");
  p["self_collision"] = false;
  w.start(p);
  w.of("r/right_elbow", keys::joint_position_target) = 0.9;
  w.run_for(2);
  EXPECT_NEAR(w.q("r/right_elbow"), 0.9, 0.05);
  EXPECT_TRUE(w.world().values(r.base(), keys::contacts).empty());
  EXPECT_FALSE(w.world().store().find(r.base(), keys::self_collision.name)) << "nobody is asked";
}

TEST(AnArm, RestsOnTheTrunkHoweverLightItIs) {
  for (const double arm : {0.01, 0.1, 1.0})
    for (const double frequency : {50.0, 200.0}) {
      World w;
      w.add("r", robot_with_arms(arm, true));
      w.start(with_self_collision("free", frequency));
      w.world().value(w.world().find_robot("r")->base(), keys::pose).position.z() = 0;
      w.of("r/right_elbow", keys::joint_position_target) = w.of("r/left_elbow", keys::joint_position_target) = 0.55;
      w.run_for(1.5);
      for (const char* joint : {"r/right_elbow", "r/left_elbow"}) {
        EXPECT_LT(std::abs(w.v(joint)), 1e-3) << arm << " kg, " << frequency << " Hz, " << joint;
        EXPECT_NEAR(w.q(joint), touching, 0.05) << arm << " kg, " << frequency << " Hz, " << joint;
      }
    }
}

/// Returns a plate, and over it two links that turn about upright axes, as in a SCARA. The last link lies 2 mm deep in
/// the plate.
RobotTree scara() {
  const Shape plate = test::with(Shape::box({0.8, 0.8, 0.1}), 0.5), arm = test::with(Shape::box({0.3, 0.1, 0.1}), 0.5);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("plate");
    b.set(keys::inertial, test::solid_box(5, {0.8, 0.8, 0.1}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&plate, 1));
    b.revolute("shoulder", Vec3::UnitZ(), {.lower = -2, .upper = 2, .effort = 20});
    b.body("upper_arm");
    b.set(keys::inertial, test::solid_box(1, {0.2, 0.1, 0.1}));
    b.translation({0.2, 0, 0.098});
    b.revolute("elbow", Vec3::UnitZ(), {.lower = -2, .upper = 2, .effort = 20});
    b.body("forearm");
    b.set(keys::inertial, test::solid_box(1, {0.3, 0.1, 0.1}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&arm, 1));
  });
}

TEST(AnArm, MovesFreelyAcrossWhatNoJointLetsItLeave) {
  for (const char* base : {"fixed", "free"}) {
    World w;
    w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const RobotView& r = w.add("r", scara(), {{1, 2, 3}, from_rpy(0.3, 0.2, 0.1)});
    w.start(with_self_collision(base));
    w.of("r/elbow", keys::joint_position_target) = 1;
    w.of("r/shoulder", keys::joint_position_target) = -0.5;
    w.run_for(1.5);
    EXPECT_FALSE(w.world().values(r.base(), keys::contacts).empty()) << base;
    EXPECT_NEAR(w.q("r/elbow"), 1, 0.01) << base;
    EXPECT_NEAR(w.q("r/shoulder"), -0.5, 0.01) << base;
  }
}

TEST(ALightForearm, RestsUnderAStrongDrive) {
  World w;
  const RobotView& r = w.add("r", robot_with_arms(0.1));
  Parameters p = with_self_collision("fixed");
  p["velocity_joints"] = std::vector<std::string>{"right_shoulder"};
  p["effort_joints"] = std::vector<std::string>{"right_elbow"};
  w.start(p);
  w.of("r/right_elbow", keys::joint_effort_target) = 2;
  w.run_for(1);
  EXPECT_LT(std::abs(w.v("r/right_elbow")), 1e-3) << "rad/s";
  const auto contacts = w.world().values(r.base(), keys::contacts);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_LT(contacts[0].depth, 0.02) << "m";
  // torques about the elbow: the drive, the weight and the contact
  const Wrench on_arm = w.world().value("r/right_forearm", keys::contact_wrench);
  const double weight = 0.1 * g * 0.125 * std::sin(w.q("r/right_elbow"));
  EXPECT_NEAR(on_arm.torque.y() + 2 - weight, 0, 0.01) << "N m";
  RecordProperty("depth", std::to_string(contacts[0].depth) + " m, " + std::to_string(on_arm.force.norm()) + " N");
}

TEST(ARobotInFlight, KeepsItsMomentaWhileItsArmsHitItsTrunk) {
  World w;
  w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& r =
      w.add("r", robot_with_arms(0.5, true), {{1, 2, 3}, Quat::Identity()}, {{0.5, -0.3, 0.2}, {0.5, -1, 1.5}});
  w.start(with_self_collision("free"));
  w.refresh();
  const Motion before = motion_of(w, r);
  double most = 0;
  for (int k = 0; k < 40; ++k) {
    w.of("r/right_elbow", keys::joint_position_target) = k % 2 == 0 ? 1 : 0;
    w.of("r/left_elbow", keys::joint_position_target) = k % 3 == 0 ? 0.8 : 0.1;
    w.run_for(0.05);
    w.refresh();
    const Motion now = motion_of(w, r);
    most = std::max(most, w.world().value(r.base(), keys::contact_wrench).force.norm());
    EXPECT_LT((now.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm()) << k;
    EXPECT_LT((now.angular - before.angular).norm(), 1e-9 * before.angular.norm()) << k;
  }
  EXPECT_GT(most, 5) << "N: they hit it";
}

TEST(AHumanoidInFlight, KeepsItsMomentaWhileItsLimbsHitEachOther) {
  World w;
  w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotTree humanoid = w.read_model(MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf");
  const RobotView& r = w.add("r", humanoid, {{1, 2, 3}, Quat::Identity()}, {{0.5, -0.3, 0.2}, {1, -2, 3}});
  w.start({{"joints", std::string("position")}, {"self_collision", true}});
  w.refresh();
  const Motion before = motion_of(w, r);
  test::Randoms random(7);
  std::size_t most = 0;
  double deepest = 0;
  for (int k = 0; k < 60; ++k) {
    for (const Link& link : r.links)
      if (link.joint != JointKind::fixed)
        w.world().value(link.joint_object, keys::joint_position_target) = random.uniform(-1.5, 1.5);
    for (int i = 0; i < 10; ++i) {
      w.run_for(0.02);
      const auto contacts = w.world().values(r.base(), keys::contacts);
      most = std::max(most, contacts.size());
      for (const Contact& c : contacts) deepest = std::max(deepest, c.depth);
    }
    w.refresh();
    const Motion now = motion_of(w, r);
    ASSERT_LT((now.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm()) << k;
    ASSERT_LT((now.angular - before.angular).norm(), 1e-9 * before.angular.norm()) << k;
  }
  EXPECT_GT(most, 3u) << "contacts at once";
  EXPECT_LT(deepest, 0.03) << "m";
  RecordProperty("most", std::to_string(most) + " contacts, " + std::to_string(deepest) + " m");
}

/// Returns a ball of 1 kg on two slides, along x and along z, beside a trunk that does not move.
RobotTree pressed_ball() {
  const Shape trunk = test::with(Shape::box({0.3, 0.3, 4}), 0.5), ball = test::with(Shape::sphere(0.1), 0.5);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, test::solid_box(10, {0.3, 0.3, 4}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&trunk, 1));
    b.translation({0.25, 0, 0});
    b.prismatic("press", -Vec3::UnitX(), {.lower = -1, .upper = 1, .effort = 100});
    b.body("carriage");
    b.set(keys::inertial, test::round_body(0.1, 0.05));
    b.prismatic("slide", Vec3::UnitZ(), {.lower = -9, .upper = 9});
    b.body("ball");
    b.set(keys::inertial, test::round_body(1, 0.1));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
  });
}

TEST(FrictionBetweenLinks, HoldsAndSlidesAsCoulombSays) {
  for (const double pressed : {1.1, 0.5}) {  // ratio to the force that is needed to hold it
    World w;
    w.add("r", pressed_ball());
    w.start({{"joints", std::string("passive")},
             {"effort_joints", std::vector<std::string>{"press"}},
             {"base", std::string("fixed")},
             {"self_collision", true}});
    w.of("r/press", keys::joint_effort_target) = pressed * g / 0.5;
    w.run_for(0.4);
    const double before = w.v("r/slide");
    w.run_for(0.2);
    const double gained = w.v("r/slide") - before;
    if (pressed > 1) {
      EXPECT_LT(std::abs(w.v("r/slide")), 1e-6) << "m/s: it holds";
    } else {
      EXPECT_NEAR(gained, -(1 - pressed) * g * 0.2, 0.002 * g * 0.2);
    }
  }
}

TEST(SelfCollision, GivesTheSameBitsOnTwoThreadsAndFromASnapshot) {
  const auto run = [](unsigned threads, bool restores) {
    World w;
    w.add_ground();
    for (int i = 0; i < 6; ++i)
      w.add("r" + std::to_string(i), robot_with_arms(0.3 + 0.1 * i, true), {{1.2 * i, 0, 0.4}, Quat::Identity()});
    w.start(with_self_collision("free"));
    w.set_threads(threads);
    for (int i = 0; i < 6; ++i) w.of("r" + std::to_string(i) + "/right_elbow", keys::joint_position_target) = 0.9;
    w.run_for(0.4);
    const Snapshot middle = w.snapshot();
    if (restores) {
      w.run_for(0.2);
      w.restore(middle);
    }
    w.run_for(0.4);
    return w.state_hash();
  };
  const std::uint64_t straight = run(1, false);
  EXPECT_EQ(straight, run(2, false));
  EXPECT_EQ(straight, run(1, true));
}

TEST(SelfCollision, EndsWithTheMotionThatWantsIt) {
  World w;
  const RobotView& r = w.add("r", robot_with_arms(1));
  w.use("motion.articulated", 1000, {{&r, r.base(), 0}}, with_self_collision("fixed"));
  w.use("motion.point", 1000, {{&r, r.base(), 1}});
  w.set_levels(r, {"articulated", "point"}, 0);
  w.use_contacts();
  w.build();
  w.of("r/right_elbow", keys::joint_position_target) = 0.6;
  for (int round = 0; round < 2; ++round) {
    w.world().value(r.base(), keys::motion_level_target) = 0;
    w.run_for(1);
    EXPECT_EQ(w.world().values(r.base(), keys::contacts).size(), 1u) << "round " << round;
    EXPECT_GT(w.world().value(r.base(), keys::contact_wrench).force.norm(), 1) << "N, round " << round;
    w.world().value(r.base(), keys::motion_level_target) = 1;
    w.run_for(0.1);
    EXPECT_EQ(w.world().value(r.base(), keys::self_collision), 0u);
    EXPECT_TRUE(w.world().values(r.base(), keys::contacts).empty()) << "round " << round;
    EXPECT_EQ(w.world().value(r.base(), keys::contact_wrench).force, Vec3(0, 0, 0)) << "round " << round;
  }
}

TEST(SelfCollision, TakesNoMemoryInAStep) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(test::allocations(), 0u) << "sanitizers count allocations themselves";
#else
  World w;
  w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& r = w.add("r", robot_with_arms(0.5, true));
  w.start(with_self_collision("free"));
  std::uint64_t before = 0;
  for (const double target : {1.0, 0.0, 1.0}) {
    before = test::allocations();
    w.of("r/right_elbow", keys::joint_position_target) = w.of("r/left_elbow", keys::joint_position_target) = target;
    w.run_for(0.5);
    EXPECT_EQ(w.world().values(r.base(), keys::contacts).size(), target > 0 ? 2u : 0u) << "both arms touch, or none";
  }
  EXPECT_EQ(test::allocations() - before, 0u) << "when they touch again";
#endif
}

}  // namespace
}  // namespace muro::articulated::testing
