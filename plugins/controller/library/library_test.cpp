// SPDX-License-Identifier: MIT
// controller.library in real simulations: steps of control code.
#include "library_testing.hpp"

namespace muro::control {
namespace {

std::string failure(Simulation& s, double seconds) {
  try {
    s.run_for(seconds);
  } catch (const StepError& e) {
    return e.what();
  }
  return "it went well";
}

TEST(ControllerLibrary, SteersEachRobotWithAStateOfItsOwn) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  team.run_for(0.3);
  const double va = team.command(*team.a).linear.x(), vb = team.command(*team.b).linear.x();
  EXPECT_GT(va, 0.1);
  EXPECT_NE(va, vb) << "seeds differ between robots";
  EXPECT_NEAR(team.twist(*team.a).linear.norm(), va, 1e-12);
  EXPECT_EQ(team.command(*team.a).angular.z(), 1) << "in the first seven steps";
  team.run_for(0.5);
  EXPECT_EQ(team.command(*team.a).angular.z(), -1) << "the state counts steps";
}

TEST(ControllerLibrary, TakesItsChancesFromTheSeedOfTheSimulation) {
  const auto speed = [](std::uint64_t seed) {
    Team team(seed);
    team.control(folder + "circle.so");
    team.build();
    team.run_for(0.1);
    return team.command(*team.a).linear.x();
  };
  EXPECT_EQ(speed(1), speed(1));
  EXPECT_NE(speed(1), speed(2));
}

TEST(ControllerLibrary, BeginsAnewAfterAResetToTheBit) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  team.run_for(2.3);
  const std::uint64_t end = team.state_hash();
  team.reset();
  team.run_for(1.1);
  EXPECT_NE(team.state_hash(), end);
  team.run_for(1.2);
  EXPECT_EQ(team.state_hash(), end);
}

TEST(ControllerLibrary, GoesOnFromASnapshotToTheSameBits) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  const Snapshot start = team.snapshot();
  team.run_for(0.9);
  const Snapshot middle = team.snapshot();
  team.run_for(1.4);
  const std::uint64_t end = team.state_hash();
  team.restore(middle);
  team.run_for(1.4);
  EXPECT_EQ(team.state_hash(), end);
  team.restore(start);
  team.run_for(2.3);
  EXPECT_EQ(team.state_hash(), end);
}

TEST(ControllerLibrary, LetsTwoLibrariesOrTwiceTheSameServeOneRobot) {
  Team team;
  team.control_by(folder + "circle.so", {{team.a, team.a->base()}}, {{"arguments", Texts{"name=first"}}});
  team.control_by(folder + "circle.so", {{team.a, team.a->base()}},
                  {{"arguments", Texts{"name=second"}}, {"outputs", Texts{"command.twist=b/body:command.twist"}}});
  team.build();
  team.run_for(1);
  EXPECT_GT(team.command(*team.a).linear.x(), 0.1);
  EXPECT_GT(team.command(*team.b).linear.x(), 0.1);
}

TEST(ControllerLibrary, HandsOverNamePeriodSizesAndArguments) {
  const auto failure_with = [](const std::string& argument) {
    Team team;
    team.control(folder + "circle.so", {{"arguments", Texts{"other=1", argument}}});
    team.build();
    return failure(team, 1);
  };
  EXPECT_TRUE(says(failure_with("tell=all"), "robot `a`: `circle` fails: robot a, period 0.1, sizes 7"));
  EXPECT_TRUE(says(failure_with("tell=nothing"), "robot `a`: `circle` fails without giving a reason"));
  EXPECT_TRUE(says(failure_with("tell=endless"), "`circle` fails: xxxxxxxx"));
}

TEST(ControllerLibrary, EndsTheRunWithTheLibrarysReasonAndTheRobotsName) {
  Team team;
  team.control(folder + "circle.so", {{"arguments", Texts{"fail_at=5"}}});
  team.build();
  const std::string said = failure(team, 2);
  EXPECT_TRUE(says(said, "failed at t = 0.5"));
  EXPECT_TRUE(says(said, "robot `a`: `circle` fails: lost at x = "));
  EXPECT_TRUE(says(said, " after 0.50 s"));
}

TEST(ControllerLibrary, EndsTheRunWhenAnOutputIsNoFiniteNumber) {
  Team team;
  team.control(folder + "circle.so", {{"arguments", Texts{"nan_at=3"}}});
  team.build();
  EXPECT_TRUE(says(failure(team, 2),
                   "robot `a`: output `command.twist` of `circle`[5] is not a number; outputs must be finite numbers"));
}

#ifdef FORTRAN_CONTROLLER
TEST(ControllerLibrary, MayBeWrittenInFortran) {
  Team team;
  team.control(FORTRAN_CONTROLLER);
  team.build();
  team.run_for(1);
  EXPECT_EQ(team.command(*team.a).linear.x(), 0.5);
}
#endif

}  // namespace
}  // namespace muro::control
