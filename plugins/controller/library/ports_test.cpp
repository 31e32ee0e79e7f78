// SPDX-License-Identifier: MIT
// Reading and writing of ports in simulations: integers, texts, lists, several objects by a pattern, units of joints.
#include <cmath>
#include <sstream>

#include "connections.hpp"
#include "library_testing.hpp"
#include "tests/support/bodies.hpp"

namespace muro::control {
namespace {

/// Four robots that are not in the order of their names. Control code of `bots_10` reads the inputs of the test.
struct Looking : test::Scene {
  explicit Looking(Settings settings) {
    const RobotTree tree = two_arms();
    for (const char* name : {"bots_10", "bots_2", "bots_1", "other"})
      robots.push_back(&add(name, tree, {{double(robots.size()), 0, 0}, Quat::Identity()}));
    use("motion.point", 20, all_robots(), {{"joints", "passive"}});
    if (!settings.contains("outputs")) settings["outputs"] = Texts{"commands=command.twist"};
    settings["library"] = folder + "look.so";
    use("controller.library", 10, {{robots[0], robots[0]->base()}}, std::move(settings));
    set_log([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  }
  std::string seen() {
    build();
    run_for(0.1);
    return log;
  }
  Twist& command(int i) { return world().value(robots[std::size_t(i)]->base(), keys::command_twist); }
  std::vector<const RobotView*> robots;
  std::string log;
};

constexpr Key<std::int64_t> big_numbers{"big", "1", "of the test"};
constexpr Key<std::uint8_t> bytes{"bytes", "1", "of the test"};
constexpr Key<ObjectId> things{"things", "1", "of the test"};
constexpr Key<TextId> labels{"labels", "1", "of the test"};

TEST(Ports, OfAPatternStandSideBySideInTheOrderOfTheScenario) {
  Looking s({{"inputs", Texts{"numbers=bots_*/body:pose"}}, {"outputs", Texts{"commands=bots_*/body:command.twist"}}});
  EXPECT_TRUE(says(s.seen(), "`look` says: numbers 0 0 0 0 0 0 1 1 0 0 0 0 0 1 2 0 0 0 0 0 1,"));
  EXPECT_TRUE(says(s.log, "`look` says: outputs 18\n"));
  EXPECT_EQ(s.command(0).linear.x(), 1);
  EXPECT_EQ(s.command(1).linear.x(), 7);
  EXPECT_EQ(s.command(2).linear.x(), 13);
  EXPECT_EQ(s.command(3).linear.x(), 0) << "is no bot";
}

TEST(Ports, OfAPatternNameObjectsOfTheirOwnRobotFirst) {
  Looking s({{"inputs", Texts{"numbers=*_arm:pose,other/body:pose"}}});
  s.use_kinematics();
  EXPECT_TRUE(says(s.seen(), "numbers 0 0 0 0 0 0 1 0 0 0 0 0 0 1 3 0 0 0 0 0 1,")) << "two arms, and the other robot";
}

TEST(Ports, OfAPatternThatFitsNothingAreRefused) {
  const auto refused = [](const std::string& input) {
    Looking s({{"inputs", Texts{input}}});
    return refusal(s);
  };
  EXPECT_TRUE(
      says(refused("numbers=bot_*/body:pose"),
           "robot `bots_10`: input `numbers` of `look` cannot be connected: no object has a name like "
           "`bot_*/body` (a `*` stands for any characters but `/`) (did you mean `bots_2/body`?); there are: "));
  EXPECT_TRUE(says(refused("numbers=bots*:pose"), "no object has a name like `bots*`"));
  EXPECT_TRUE(
      says(refused("numbers=bots_*/body:psoe"), "no object with a name like `bots_*/body` has a property `psoe`"));
}

TEST(Ports, MatchPatternsWithinAPartOfAName) {
  EXPECT_TRUE(matches("*", "abc"));
  EXPECT_TRUE(matches("a*c", "abbc"));
  EXPECT_TRUE(matches("a*b*/c", "axbyb/c"));
  EXPECT_TRUE(matches("abc*", "abc"));
  EXPECT_FALSE(matches("*", "a/b"));
  EXPECT_FALSE(matches("a*", "b"));
  EXPECT_FALSE(matches("a*c", "abcd"));
  EXPECT_FALSE(matches("", "a"));
}

TEST(Ports, OfIntegersAreExact) {
  Looking s({{"inputs", Texts{"whole=big"}}});
  const std::vector<std::int64_t> values{(std::int64_t(1) << 53) + 1, -7};
  s.world().set_array(s.robots[0]->base(), big_numbers, std::span<const std::int64_t>(values));
  EXPECT_TRUE(says(s.seen(), ", whole 9007199254740993 -7,"));
  Looking real({{"inputs", Texts{"whole=pose"}}});
  EXPECT_TRUE(says(refusal(real), "`bots_10/body:pose` is of type muro.Pose, but the port is of integers"));
}

TEST(Ports, OfTextsReadBytesTextsAndNamesOfObjects) {
  const std::string greeting = "hello there";
  Looking s({{"inputs", Texts{"words=bytes,things,labels", "short=bytes"}}});
  World& world = s.world();
  const ObjectId base = s.robots[0]->base();
  world.set_array(base, bytes, std::span(reinterpret_cast<const std::uint8_t*>(greeting.data()), greeting.size()));
  const std::vector<ObjectId> named{s.robots[3]->base(), no_object};
  world.set_array(base, things, std::span<const ObjectId>(named));
  const std::vector<TextId> texts{world.intern("first"), world.intern("second")};
  world.set_array(base, labels, std::span<const TextId>(texts));
  EXPECT_TRUE(says(s.seen(), "words [hello there other/body first second]")) << "lines, of which a log makes one";
  EXPECT_TRUE(says(s.log, "short [hello]")) << "cut to its size";
  Looking wrong({{"inputs", Texts{"words=pose"}}});
  EXPECT_TRUE(says(refusal(wrong),
                   "`bots_10/body:pose` is of type muro.Pose; a port of texts reads texts that are "
                   "constants, names of objects, and bytes"));
}

/// Returns the numbers after the last "list" of a log.
std::vector<double> last_list(const std::string& log) {
  std::istringstream words(log.substr(log.rfind(", list") + 6));
  std::vector<double> numbers;
  for (double x = 0; words >> x;) numbers.push_back(x);
  return numbers;
}

TEST(Ports, OfListsHaveAsManyNumbersAsThereAreNow) {
  const Shape shape = Shape::sphere(0.1);
  const RobotTree ball = test::single_body(shape, {.mass = 1, .ixx = 0.004, .iyy = 0.004, .izz = 0.004});
  test::Scene s;
  const RobotView& a = s.add("a", ball);
  for (const auto& [name, at] : {std::pair{"b", Vec3(0.19, 0, 0)}, {"c", Vec3(0, 0.195, 0)}, {"d", Vec3(0, -0.195, 0)}})
    s.add(name, ball, {at, Quat::Identity()});
  s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  s.use("motion.simplified", 1000, s.all_robots());
  const RobotView& driven = s.add("driven", two_arms(), {{50, 0, 0}, Quat::Identity()});
  s.use("motion.point", 10, {{&driven, driven.base()}});
  s.use_contacts();
  std::string log;
  s.set_log([&](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  s.use("controller.library", 10, {{&a, a.base()}},
        {{"library", folder + "look.so"},
         {"inputs", Texts{"list=contacts"}},
         {"outputs", Texts{"commands=driven/body:command.twist"}}});
  s.build();
  s.run_for(0.05);
  const std::vector<double> numbers = last_list(log);
  ASSERT_EQ(numbers.size(), 14u) << "of three contacts the two for which there is room: point, normal, depth";
  for (const double* contact : {&numbers[0], &numbers[7]}) {
    EXPECT_NEAR(std::hypot(contact[0], contact[1], contact[2]), 0.1, 0.006);
    EXPECT_NEAR(std::hypot(contact[3], contact[4], contact[5]), 1, 1e-5);
    EXPECT_GT(contact[6], 0.004);
  }
  s.run_for(3);  // they push each other away
  EXPECT_EQ(last_list(log).size(), 0u);
  Looking fixed({{"inputs", Texts{"list=pose"}}});
  EXPECT_TRUE(says(refusal(fixed), "`bots_10/body:pose` has a fixed length, but the port is a list"));
}

TEST(Ports, InRadiansAreForJointsThatTurn) {
  const auto looking = [](const std::string& input) {
    auto s = std::make_unique<Looking>(Settings{{"inputs", Texts{input}}});
    return s;
  };
  const std::unique_ptr<Looking> turning = looking("velocity=left:joint.velocity");
  turning->world().set(turning->world().object("bots_10/left"), keys::joint_velocity, 0.5);
  EXPECT_NO_THROW(turning->build());
  test::Scene s;
  const RobotTree slider = test::tree_of([](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
    b.prismatic("rail", Vec3::UnitX(), {});
    b.body("sled");
  });
  const RobotView& a = s.add("a", slider);
  s.world().set(s.world().object("a/rail"), keys::joint_velocity, 0.5);
  s.use("motion.point", 20, s.all_robots(), {{"joints", "passive"}});
  s.use("controller.library", 10, {{&a, a.base()}},
        {{"library", folder + "look.so"},
         {"inputs", Texts{"velocity=joint.velocity"}},
         {"outputs", Texts{"commands=command.twist"}}});
  EXPECT_TRUE(says(refusal(s),
                   "`a/rail:joint.velocity` is in \"m/s\", for the joint shifts, but the library works in "
                   "\"rad/s\""));
}

TEST(ControllerLibrary, TakesTheUnitOfTheJointThatAnEncoderLooksAt) {
  const auto read_encoder_of = [](const RobotTree& tree, const std::string& joint) {
    test::Scene s;
    const RobotView& a = s.add("a", tree);
    const ObjectId encoder = s.add_sensor_object(a, "encoder", s.world().object("a/" + joint));
    s.use("motion.point", 20, s.all_robots());
    s.use("sensor.encoder", 20, {{&a, encoder}});
    s.use("controller.library", 10, {{&a, a.base()}},
          {{"library", folder + "look.so"},
           {"inputs", Texts{"velocity=encoder.velocity"}},
           {"outputs", Texts{"commands=command.twist"}}});
    return refusal(s);
  };
  EXPECT_EQ(read_encoder_of(two_arms(), "left"), "no complaint");
  const RobotTree slider = test::tree_of([](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
    b.prismatic("rail", Vec3::UnitX(), {});
    b.body("sled");
  });
  EXPECT_TRUE(says(read_encoder_of(slider, "rail"),
                   "`a/encoder:encoder.velocity` is in \"m/s\", for the joint shifts, but the library works in "
                   "\"rad/s\""));
}

/// The legs of a robot with coupled hips, and a sled behind them. The right hip follows the left one with opposite sign
/// and an offset of 0.1 rad.
struct CoupledHips : test::Scene {
  explicit CoupledHips(Texts outputs, const std::string& library = "look.so", Texts inputs = {}) {
    robot = &add("nao", test::tree_of([](RobotBuilder& b) {
                   const auto part = [&](const char* name) {
                     b.body(name);
                     b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
                   };
                   b.base("body");
                   b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
                   b.fork();
                   b.revolute("left_hip", Vec3::UnitZ(), {});
                   part("left_leg");
                   b.end();
                   b.fork();
                   b.revolute("right_hip", Vec3::UnitZ(), {});
                   b.mimic("left_hip", -1, 0.1);
                   part("right_leg");
                   b.end();
                   b.prismatic("rail", Vec3::UnitX(), {});
                   part("sled");
                   b.end();
                   b.end();
                 }));
    use("motion.point", 100, all_robots(), {{"joints", "position"}});
    Settings settings{{"library", folder + library}, {"outputs", std::move(outputs)}};
    if (!inputs.empty()) settings["inputs"] = std::move(inputs);
    use("controller.library", 10, {{robot, robot->base()}}, settings);
    set_log([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  }
  double joint(const std::string& name) { return world().value("nao/" + name, keys::joint_position); }
  const RobotView* robot = nullptr;
  std::string log;
};

TEST(Ports, LeaveAJointThatFollowsAnotherOneToItsLeader) {
  CoupledHips s({"commands=left_hip:joint.position.target,right_hip:joint.position.target,rail:joint.position.target"});
  s.build();
  EXPECT_TRUE(says(s.log,
                   "robot `nao`: output `commands` of `look`: what it writes to `nao/right_hip:joint.position.target` "
                   "is left out, for the joint follows `left_hip` (a mimic joint)"));
  s.run_for(0.5);
  EXPECT_TRUE(says(s.log, "outputs 3")) << "the library has its place all the same";
  EXPECT_NEAR(s.joint("left_hip"), 1, 1e-12) << "look writes 1, 2, 3";
  EXPECT_NEAR(s.joint("right_hip"), -1 + 0.1, 1e-12);
  EXPECT_NEAR(s.joint("rail"), 3, 1e-12);
}

TEST(Ports, RefuseAJointThatFollowsWithoutItsLeader) {
  CoupledHips alone({"commands=right_hip:joint.position.target,rail:joint.position.target"});
  EXPECT_TRUE(says(refusal(alone),
                   "output `commands` of `look` cannot be connected: `nao/right_hip:joint.position.target` cannot be "
                   "written: the joint follows `left_hip` (a mimic joint), which takes the target of both; write "
                   "\"left_hip:joint.position.target\" in its place, or beside it in the same port"));
  CoupledHips unknown({"commands=left_hip:joint.position.target,right_hip:joint.psition.target"});
  EXPECT_TRUE(says(refusal(unknown), "object `nao/right_hip` has no property `joint.psition.target`"));
}

TEST(Ports, MayHaveAUnitForEachProperty) {
  const Texts outputs{"commands=command.twist"};
  const auto reading = [&](const std::string& input) {
    CoupledHips s(outputs, "look.so", {"mixed=" + input});
    return refusal(s);
  };
  EXPECT_EQ(reading("left_hip:joint.position,right_hip:joint.position,rail:joint.position"), "no complaint");
  EXPECT_TRUE(says(reading("left_hip:joint.position,rail:joint.position,right_hip:joint.position"),
                   "input `mixed` of `look` cannot be connected: `nao/rail:joint.position` is in \"m\", for the joint "
                   "shifts, but the library works in \"rad\" there (\"rad, rad, m\")"));
  EXPECT_TRUE(says(reading("left_hip:joint.position,rail:joint.position"),
                   "its unit in the library is \"rad, rad, m\", which is one for each of 3 properties, but 2 are "
                   "connected"));
}

TEST(Ports, InRadiansOrMetresAreForJointsOfBothKinds) {
  CoupledHips s({"commands=command.twist"}, "look.so",
                {"either=left_hip:joint.position,rail:joint.position,right_hip:joint.position"});
  EXPECT_EQ(refusal(s), "no complaint");
}

}  // namespace
}  // namespace muro::control
