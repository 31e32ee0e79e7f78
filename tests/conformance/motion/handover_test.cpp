// SPDX-License-Identifier: MIT
// Robots that change from one motion to another during a run, for every pair of motions.
#include <gtest/gtest.h>

#include "tests/conformance/motion/case.hpp"
#include "tests/support/files.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {
namespace {

using Pair = std::tuple<std::string, std::string>;

/// Returns the motions that can move a vehicle with two wheels.
std::vector<std::string> vehicle_motions() {
  std::vector<std::string> all{"motion.point", "motion.differential_drive"};
  for (const std::string& id : motions())
    if ((description_of(id).features & feature_forces) != 0) all.push_back(id);
  return all;
}

/// Returns all pairs of two different motions.
std::vector<Pair> pairs_of(const std::vector<std::string>& motions) {
  std::vector<Pair> all;
  for (const std::string& a : motions)
    for (const std::string& b : motions)
      if (a != b) all.emplace_back(a, b);
  return all;
}

/// Returns the motions that can move a block, which has no wheels.
std::vector<std::string> block_motions() {
  std::vector<std::string> some = vehicle_motions();
  std::erase(some, "motion.differential_drive");
  return some;
}

std::string name_of_handover(const ::testing::TestParamInfo<Pair>& test) {
  std::string name = std::get<0>(test.param) + "_to_" + std::get<1>(test.param);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Features features_of(const std::string& motion) { return description_of(motion).features; }

class EveryHandOver : public ::testing::TestWithParam<Pair> {
 protected:
  std::string first() const { return std::get<0>(GetParam()); }
  std::string second() const { return std::get<1>(GetParam()); }
};

class EveryHandOverOfABlock : public EveryHandOver {};

constexpr double radius = 0.05, speed = 0.5, dt = 0.001;

/// A vehicle in space that moves at a constant speed; its wheels turn as if it rolled.
struct Flight : test::Scene {
  const RobotView* robot;
  double spin = speed / radius;  ///< of the wheels, rad/s

  Flight(const std::string& a, const std::string& b) {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    if (a == "motion.point" && b != "motion.differential_drive") spin = 0;
    if (b == "motion.point" && a != "motion.differential_drive") spin = 0;
    RobotTree tree = test::tree_of([](RobotBuilder& builder) {
      builder.base("chassis");
      builder.set(keys::inertial, solid_box(4, {0.3, 0.2, 0.1}));
      for (const double side : {1.0, -1.0}) {
        if (side > 0) builder.fork();
        builder.translation({0, 0.15 * side, 0});
        builder.revolute(side > 0 ? "left" : "right", Vec3::UnitY(), {});
        builder.body(side > 0 ? "left_wheel" : "right_wheel");
        builder.set(keys::inertial, Inertia{.mass = 0.3, .ixx = 4e-4, .iyy = 6e-4, .izz = 4e-4});
        const Shape wheel = test::tyre(radius);
        builder.set_array(keys::collision_shapes, std::span<const Shape>(&wheel, 1));
        if (side > 0) builder.end();
      }
      builder.end();
    });
    robot = &add("r", tree, {{0, 0, 5}, Quat::Identity()}, {{speed, 0, 0}, Vec3::Zero()});
    use(a, 1000, {{robot, robot->base(), 0}});
    use(b, 1000, {{robot, robot->base(), 1}});
    set_levels(*robot, {"a", "b"}, 0);
    use_contacts();
    build();
    for (const char* joint : {"r/left", "r/right"}) {
      if (world().has(world().object(joint), "joint.velocity.target"))
        world().value(joint, keys::joint_velocity_target) = spin;
      if (a != "motion.point" && a != "motion.differential_drive") world().value(joint, keys::joint_velocity) = spin;
    }
    if (world().has(robot->base(), "command.twist"))
      world().value(robot->base(), keys::command_twist) = {{speed, 0, 0}, Vec3::Zero()};
  }
  double& of(const char* joint, const Key<double>& key) { return world().value(joint, key); }
  void hand_over(std::int32_t level) { world().value(robot->base(), keys::motion_level_target) = level; }
};

TEST_P(EveryHandOver, KeepsPositionVelocityAndJoints) {
  Flight f(first(), second());
  f.run_for(0.1);
  for (const std::int32_t level : {1, 0, 1}) {
    const Pose before = f.pose(*f.robot);
    const double wheel = f.of("r/left", keys::joint_position);
    const double turning = f.of("r/left", keys::joint_velocity);
    ASSERT_NEAR(f.twist(*f.robot).linear.x(), speed, 1e-9);
    f.hand_over(level);
    f.run_for(dt);
    EXPECT_EQ(f.world().value(f.robot->base(), keys::motion_level), std::uint32_t(level));
    EXPECT_LT((f.pose(*f.robot).position - before.position - Vec3(speed * dt, 0, 0)).norm(), 1e-12) << "to " << level;
    EXPECT_LT(f.pose(*f.robot).orientation.angularDistance(before.orientation), 1e-12);
    EXPECT_LT((f.twist(*f.robot).linear - Vec3(speed, 0, 0)).norm(), 1e-12);
    EXPECT_LT(f.twist(*f.robot).angular.norm(), 1e-12);
    const bool point = first() == "motion.point" || second() == "motion.point";  // motion.point does not turn wheels
    const bool turn = !point && (features_of(first()) & features_of(second()) & feature_joints) != 0;
    if (turn) {
      EXPECT_NEAR(f.of("r/left", keys::joint_velocity), turning, 1e-12 * std::max(1.0, f.spin));
      EXPECT_NEAR(f.of("r/left", keys::joint_position), wheel + turning * dt, 1e-12);
    }
    f.run_for(0.05);
  }
  EXPECT_LT(f.pose(*f.robot).position.tail<2>().norm() - 5, 1e-9);
}

TEST_P(EveryHandOver, GoesOnFromASnapshotToTheSameBits) {
  Flight f(first(), second());
  f.run_for(0.05);
  f.hand_over(1);
  f.run_for(0.03);
  const Snapshot middle = f.snapshot();
  f.run_for(0.05);
  const std::uint64_t end = f.state_hash();
  f.restore(middle);
  f.run_for(0.05);
  EXPECT_EQ(f.state_hash(), end);
}

TEST_P(EveryHandOverOfABlock, MakesItABodyOrAnObstacleForOthers) {
  // A ball rolls against the robot: a robot moved by forces gives way, a robot moved by commands does not.
  test::Scene s;
  s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& robot = s.add("r", block(1, {0.2, 0.2, 0.2}, 0), {{0.5, 0, 0}, Quat::Identity()});
  const RobotView& ball_ = s.add("ball", ball(1, 0.1, 0), {{0, 0, 0}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
  s.use(first(), 1000, {{&robot, robot.base(), 0}});
  s.use(second(), 1000, {{&robot, robot.base(), 1}});
  s.set_levels(robot, {"a", "b"}, 0);
  s.use("motion.simplified", 1000, {{&ball_, ball_.base()}});
  s.use_contacts();
  s.build();
  s.run_for(0.1);
  s.world().value(robot.base(), keys::motion_level_target) = 1;
  s.run_for(0.9);
  const bool moved = (features_of(second()) & feature_contact) != 0;
  if (moved)
    EXPECT_GT(s.twist(robot).linear.x(), 0.3);
  else
    EXPECT_EQ(s.twist(robot).linear.x(), 0);
  EXPECT_LT(s.twist(ball_).linear.x(), 0.6) << "there was an impact on the ball";
  EXPECT_NEAR(s.twist(ball_).linear.x() + (moved ? s.twist(robot).linear.x() : 0), moved ? 1 : 0, 1e-9);
}

/// A box on the ground that holds out an arm of 0.5 kg, 0.1 m from its joint; moved by forces, or by another motion.
struct Porter : test::Scene {
  const RobotView* robot;
  test::ScratchFolder folder;

  explicit Porter(const std::string& motion, const std::string& other = "motion.point") {
    add_ground();
    robot =
        &add("r", test::tree_of([](RobotBuilder& b) {
               const Shape box = test::with(Shape::box({0.4, 0.4, 0.1}), 0.5);
               b.base("box");
               b.set(keys::inertial, solid_box(2, {0.4, 0.4, 0.1}));
               b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
               b.revolute("joint", Vec3::UnitY(), {.lower = -1, .upper = 1, .effort = 10});
               b.body("arm");
               b.set(keys::inertial, Inertia{.mass = 0.5, .com = {0.1, 0, 0}, .ixx = 1e-3, .iyy = 1e-3, .izz = 1e-3});
             }),
             {{0, 0, 0.05}, Quat::Identity()});
    use(motion, 1000, {{robot, robot->base(), 0}}, {{"joints", std::string("position")}});
    std::map<std::string, ParameterInput> parameters;
    if (other == motion) parameters["world"] = std::string("another");
    use(other, 1000, {{robot, robot->base(), 1}}, parameters);
    set_levels(*robot, {"forces", "other"}, 0);
    use("recorder.contacts", 1000, {}, {{"file", folder.path("contacts.csv")}});
    use_contacts();
    build();
  }
  void hand_over(std::int32_t level) { world().value(robot->base(), keys::motion_level_target) = level; }
  double effort() { return world().value("r/joint", keys::joint_effort); }
  bool has(const KeyInfo& key) { return world().has(robot->base(), key.name); }
};

class EveryMotionByForces : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryMotionByForces, LeavesNoContactAndNoEffortBehind) {
  Porter p(GetParam());
  constexpr double weight = 2.5 * 9.81, load = 0.5 * 9.81 * 0.1;  // N, N m
  for (int round = 0; round < 2; ++round) {
    p.run_for(0.5);
    EXPECT_NEAR(std::abs(p.effort()), load, 0.02 * load) << "it holds its arm, round " << round;
    if (p.has(keys::contact_wrench)) {
      EXPECT_NEAR(p.world().value(p.robot->base(), keys::contact_wrench).force.z(), weight, 0.02 * weight) << round;
      EXPECT_FALSE(p.world().values(p.robot->base(), keys::contact_wrenches_of_motion).empty()) << round;
    }
    p.hand_over(1);
    p.run_for(dt);
    EXPECT_EQ(p.effort(), 0) << "no drive of motion.point has one";
    if (p.has(keys::contact_wrench)) {
      EXPECT_EQ(p.world().value(p.robot->base(), keys::contact_wrench).force, Vec3(0, 0, 0)) << round;
      EXPECT_TRUE(p.world().values(p.robot->base(), keys::contact_wrenches_of_motion).empty()) << round;
    }
    p.run_for(0.1);
    EXPECT_EQ(p.effort(), 0);
    p.hand_over(0);
  }
}

TEST_P(EveryMotionByForces, TellsItsContactsBesideALevelOfAnEngine) {
  if ((features_of(GetParam()) & feature_link_dynamics) == 0) return;  // contact algorithms report those of others
  for (const std::string& engine : motions()) {
    if ((description_of(engine).capabilities & Capability::world) == 0) continue;
    Porter p(GetParam(), engine);
    p.run_for(0.5);
    Vec3 sum = Vec3::Zero();
    for (const ContactWrench& c : p.world().values(p.robot->base(), keys::contact_wrenches_of_motion))
      sum += c.wrench.force;
    EXPECT_NEAR(sum.z(), 2.5 * 9.81, 0.02 * 2.5 * 9.81) << engine;
  }
}

/// The rover on a plane, with these motions as levels.
using LevelList = std::vector<std::pair<std::string, std::map<std::string, ParameterInput>>>;
struct Parked : test::Scene {
  const RobotView* rover;
  explicit Parked(const LevelList& levels) {
    add_ground();
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
    rover = &add("r", model, {{0, 0, model.standing_height()}, Quat::Identity()});
    std::vector<std::string> names;
    for (const auto& [motion, parameters] : levels) {
      use(motion, 1000, {{rover, rover->base(), std::uint32_t(names.size())}}, parameters);
      names.push_back("level_" + std::to_string(names.size()));
    }
    if (names.size() > 1) set_levels(*rover, names, 0);
    use("drive.skid_steer", 0, all_robots());
    use_contacts();
    build();
    world().value(rover->base(), keys::command_twist) = {{0.3, 0, 0}, {0, 0, 0.2}};
  }
};

TEST(ARoverWithLevels, StandsOnItsWheelsWhereOneLevelFeelsForcesOnLinks) {
  for (const std::string& engine : motions()) {
    if ((description_of(engine).capabilities & Capability::world) == 0) continue;
    Parked alone(LevelList{{"motion.simplified", {}}}), with_levels(LevelList{{"motion.simplified", {}}, {engine, {}}});
    alone.run_for(2);
    with_levels.run_for(2);
    EXPECT_LT((alone.pose(*alone.rover).position - with_levels.pose(*with_levels.rover).position).norm(), 5e-3)
        << engine;
    EXPECT_NEAR(with_levels.pose(*with_levels.rover).position.z(), 0.09, 1e-3) << engine;
  }
}

TEST(ARoverWithLevels, InTwoWorldsOfOneEngineIsDisturbedByNeither) {
  for (const std::string& engine : motions()) {
    if ((description_of(engine).capabilities & Capability::world) == 0) continue;
    Parked alone(LevelList{{engine, {{"world", std::string("u")}}}});
    Parked two(LevelList{{engine, {{"world", std::string("u")}}}, {engine, {{"world", std::string("v")}}}});
    alone.run_for(2);
    two.run_for(2);
    EXPECT_EQ(alone.pose(*alone.rover).position, two.pose(*two.rover).position) << engine;
  }
}

std::string refusal(const LevelList& levels) {
  try {
    Parked p(levels);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "";
}

TEST(ARoverWithLevels, TwiceInOneWorldIsRefused) {
  for (const std::string& engine : motions()) {
    if ((description_of(engine).capabilities & Capability::world) == 0) continue;
    const std::string text = refusal(LevelList{{engine, {}}, {engine, {{"joints", std::string("passive")}}}});
    EXPECT_NE(text.find("are of one robot and in one world of " + engine + "; give one of them another `world`"),
              std::string::npos)
        << text;
  }
}

TEST(LevelsOfOneRobot, DoNotLetAnotherHaveTwoMotions) {
  const auto engines = [] {
    std::vector<std::string> all;
    for (const std::string& id : motions())
      if ((description_of(id).capabilities & Capability::world) != 0) all.push_back(id);
    return all;
  }();
  if (engines.size() < 2) GTEST_SKIP() << "two engines are needed";
  test::Scene s;
  const RobotView& a = s.add("a", block(1, {0.2, 0.2, 0.2}, 0.5), {{0, 0, 1}, Quat::Identity()});
  const RobotView& b = s.add("b", block(1, {0.2, 0.2, 0.2}, 0.5), {{3, 0, 1}, Quat::Identity()});
  for (std::uint32_t k = 0; k < 2; ++k) {
    s.use(engines[k], 1000, {{&a, a.base(), k}});
    s.use(engines[k], 1000, {{&b, b.base(), 0}});
  }
  s.set_levels(a, {"one", "two"}, 0);
  s.use_contacts();
  try {
    s.build();
    FAIL() << "b has two motions";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("` has two writers: motion.bullet"), std::string::npos) << e.what();
  }
}

/// Returns the motions by forces.
std::vector<std::string> motions_by_forces() {
  std::vector<std::string> some = motions();
  std::erase_if(some, [](const std::string& id) { return (features_of(id) & feature_forces) == 0; });
  return some;
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotionByForces, ::testing::ValuesIn(motions_by_forces()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });
INSTANTIATE_TEST_SUITE_P(Conformance, EveryHandOver, ::testing::ValuesIn(pairs_of(vehicle_motions())),
                         name_of_handover);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryHandOverOfABlock, ::testing::ValuesIn(pairs_of(block_motions())),
                         name_of_handover);

}  // namespace
}  // namespace muro::conformance
