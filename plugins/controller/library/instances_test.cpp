// SPDX-License-Identifier: MIT
// Control code with its own memory, tunables, tasks and log lines; and control code built with the first header.
#include "library_testing.hpp"

namespace muro::control {
namespace {

constexpr Key<std::int64_t> remembered_count{"remembers.count", "1", "of the library"};
constexpr Key<std::uint8_t> remembered_status{"remembers.status", "1", "of the library"};

struct Remembering : Team {
  explicit Remembering(Settings settings = {}, const std::string& library = "remembers.so") {
    set_log([this](LogLevel level, std::string_view line) {
      log += (level == LogLevel::warning ? "warning: " : "") + std::string(line) + "\n";
    });
    control(folder + library, std::move(settings));
  }
  explicit Remembering(const char* isolate) : Remembering(Settings{{"isolate", std::string(isolate)}}) { build(); }

  std::int64_t count(int i) {
    return static_cast<const std::int64_t*>(world().store().find(a->base(), remembered_count.name)->place)[i];
  }
  std::string status() {
    return static_cast<const char*>(world().store().find(a->base(), remembered_status.name)->place);
  }
  std::string run(double seconds) {
    try {
      run_for(seconds);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "it went well";
  }
  std::string log;
};

class Isolation : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(In, Isolation, ::testing::Values("none", "process"));

TEST_P(Isolation, InstancesWithMemoryGoOnFromASnapshotToTheSameBits) {
  Remembering s(GetParam());
  const Snapshot start = s.snapshot();
  s.run_for(1.05);
  const Snapshot middle = s.snapshot();
  s.run_for(2);
  const std::uint64_t end = s.state_hash();
  const double speed = s.command(*s.a).linear.x();
  s.restore(middle);
  s.run_for(2);
  EXPECT_EQ(s.state_hash(), end);
  EXPECT_EQ(s.command(*s.a).linear.x(), speed);
  s.restore(start);
  s.run_for(3.05);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  s.run_for(3.05);
  EXPECT_EQ(s.state_hash(), end);
  EXPECT_GT(speed, 0.5) << "it has remembered where it was";
}

TEST_P(Isolation, AnotherSimulationMayGoOnFromASnapshot) {
  Remembering s(GetParam()), other("none");
  s.run_for(1);
  other.restore(s.snapshot());
  s.run_for(1);
  other.run_for(1);
  EXPECT_EQ(s.state_hash(), other.state_hash());
}

TEST_P(Isolation, APropertyOfTheLibrarysOwnHasIntegersOrText) {
  Remembering s(GetParam());
  s.run_for(1.05);
  EXPECT_EQ(s.count(0), 11);
  EXPECT_EQ(s.status(), "step 11");
  s.run_for(2);
  EXPECT_EQ(s.status(), "step 31 of ") << "of 12 bytes, with the closing zero";
}

TEST_P(Isolation, TasksRunMoreRarelyAtTheirOwnRate) {
  Remembering s(GetParam());
  s.run_for(1.05);  // at 10 Hz; the task runs every fourth step
  EXPECT_EQ(s.count(1), 3) << "at 0, 0.4 and 0.8 s";
  EXPECT_TRUE(says(s.log, "robot `a`: `remembers` says: plan at 0.800000 every 0.400000\n"));
  Remembering faster({{"isolate", std::string(GetParam())}, {"rates", Texts{"plan=5"}}});
  faster.build();
  faster.run_for(1.05);
  EXPECT_EQ(faster.count(1), 6);
}

TEST_P(Isolation, WhatAConstructorOrStepThrowsIsAnErrorText) {
  for (const auto& [when, message] : {std::pair{"fail=create", "robot `a`: `remembers` fails: this robot shall not be"},
                                      {"fail=step", "robot `a`: `remembers` fails: it has forgotten everything"}}) {
    Remembering s({{"isolate", std::string(GetParam())}, {"arguments", Texts{when}}});
    s.build();
    EXPECT_TRUE(says(s.run(1), message));
  }
}

TEST_P(Isolation, LibrariesOfTheFirstHeaderGoOnWorking) {
  Team team;
  team.control(folder + "frozen.so", {{"isolate", std::string(GetParam())}});
  team.build();
  team.run_for(0.45);
  EXPECT_EQ(team.command(*team.a).linear.x(), 0.5);
  EXPECT_NEAR(team.command(*team.a).linear.y(), 0.1, 1e-12);
}

TEST(ControllerLibrary, TellsEachInstanceItsNumberAndHowManyThereAre) {
  Remembering s({{"arguments", Texts{"tell=all"}}});
  s.build();
  s.run_for(0.1);
  EXPECT_TRUE(says(s.log, "robot `a`: `remembers` says: number 0 of 2, 1 alive\n"));
  EXPECT_TRUE(says(s.log, "robot `b`: `remembers` says: number 1 of 2, 2 alive\n"));
  s.log.clear();
  s.reset();
  s.run_for(0.1);
  EXPECT_TRUE(says(s.log, "robot `a`: `remembers` says: number 0 of 2, 1 alive\n")) << "those before were destroyed";
}

TEST(ControllerLibrary, WithoutSaveAndLoadSaysThatThereAreNoSnapshots) {
  Remembering s({}, "remembers_unsaved.so");
  s.build();
  EXPECT_TRUE(says(s.log, "warning: "));
  EXPECT_TRUE(says(s.log, "there can be no snapshots of this run: the instances of `remembers` (" + folder +
                              "remembers_unsaved.so) have memory of their own, and its table has no functions `save` "
                              "and `load`; a reset is possible"));
  const Snapshot start = s.snapshot();
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  const Snapshot middle = s.snapshot();
  s.restore(start);
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end) << "from before the first step it may go on";
  EXPECT_TRUE(says(test::complaint_of([&] { s.restore(middle); }),
                   "robot `a`: `remembers` cannot go on from a snapshot: its instances have memory of their own"));
  s.reset();
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(ControllerLibrary, SetsTunablesByTheirNames) {
  Remembering s({{"tunables", Texts{"speed=1.5", "gain=2"}}});
  s.build();
  EXPECT_TRUE(says(s.log, "`remembers` runs with speed=1.5 m/s, gain=2\n"));
  s.run_for(0.1);
  EXPECT_NEAR(s.command(*s.a).linear.x(), 3, 1e-12);
  const auto refused = [](const std::string& tunable) {
    return refusal_of("remembers.so", {{"tunables", Texts{tunable}}});
  };
  EXPECT_TRUE(says(refused("sped=1"),
                   "`tunables`: `sped=1`: library `remembers` has no tunable `sped` (did you mean `speed`?); it has: "
                   "speed, gain"));
  EXPECT_TRUE(says(refused("speed=3"),
                   "`tunables`: `speed` of `remembers` is 3; it has: speed (m/s, 0.1 to 2, default "
                   "0.5)"));
  for (const char* wrong : {"speed", "speed=fast", "speed=1 ", "speed=inf", "speed="})
    EXPECT_TRUE(says(refused(wrong), "must be \"name=number\""));
  EXPECT_TRUE(says(refusal_of("remembers.so", {{"tunables", Texts{"gain=1", "gain=2"}}}), "sets `gain` a second time"));
  EXPECT_TRUE(says(refusal_of("circle.so", {{"tunables", Texts{"gain=1"}}}), "it has: none"));
}

TEST(ControllerLibrary, RunsTasksAtWholeFractionsOfItsRateOnly) {
  Remembering s({{"rates", Texts{"plan=3"}}});
  EXPECT_TRUE(says(test::complaint_of([&] { s.build(); }),
                   "robot `a`: `remembers` runs at 10 Hz, and its task `plan` is to run at 3 Hz; the rate of "
                   "a task is a whole fraction of the controller's, set `rate` or `rates: [\"plan=2.5\"]`"));
  EXPECT_TRUE(says(refusal_of("remembers.so", {{"rates", Texts{"plan=0"}}}), "rates are above 0"));
  EXPECT_TRUE(says(refusal_of("remembers.so", {{"rates", Texts{"think=1"}}}), "has no task `think`"));
}

TEST(ControllerLibrary, ChoosesTheMotionOfItsRobotBesideRules) {
  struct Choosing : test::Scene {
    explicit Choosing(Texts rules) {
      const RobotTree tree = two_arms();
      robot = &add("a", tree);
      use("motion.point", 1000, {{robot, robot->base(), 0}});
      use("motion.simplified", 1000, {{robot, robot->base(), 1}});
      set_levels(*robot, {"far", "near"}, 0);
      world().set(world_object, keys::gravity, Vec3(0, 0, 0));
      use("level.rules", 100, {{robot, robot->base()}}, {{"rules", std::move(rules)}});
      use("controller.library", 30, {{robot, robot->base()}},
          {{"library", folder + "chooses.so"}, {"tunables", Texts{"from=0.5"}}});
      use_contacts();
      build();
    }
    std::uint32_t level() { return world().value(robot->base(), keys::motion_level); }
    const RobotView* robot = nullptr;
  };
  Choosing s({"far when out of contact for 2"});
  s.run_for(0.4);
  EXPECT_EQ(s.level(), 0u);
  s.run_for(0.2);
  EXPECT_EQ(s.level(), 1u) << "as the control code wants it";
  s.run_for(1.5);
  EXPECT_EQ(s.level(), 0u) << "as the rule that holds wants it";
}

}  // namespace
}  // namespace muro::control
