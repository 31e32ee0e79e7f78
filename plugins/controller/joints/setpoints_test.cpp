// SPDX-License-Identifier: MIT
// End of setpoints: time-outs, clients that leave, resets, snapshots.
#include <gtest/gtest.h>

#include "joints_testing.hpp"

namespace muro::joints {
namespace {

TEST(Setpoints, OfAClientThatLeavesStopTheBase) {
  Rovers s;
  s.build();
  Client client(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0 0.25");
  s.run_for(1);
  EXPECT_EQ(s.command().linear.x(), 0.5);
  client.close();
  ASSERT_TRUE(wire::run_until(s, [&] { return s.command().linear.x() == 0; }));
  EXPECT_EQ(s.command().angular.z(), 0);
}

TEST(Setpoints, OfAClientThatLeavesAreHeldWhereTheScenarioSaysSo) {
  Rovers s(stream_at("tcp=0", {{"on_disconnect", "hold"}}));
  s.build();
  Client client(s.port("rover_0/joints")), other(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0 0.25");
  ask(s, other, "time");
  client.close();
  for (int i = 0; i < 50; ++i) ask(s, other, "time");
  EXPECT_EQ(s.command().linear.x(), 0.5);
}

TEST(Setpoints, OfOneClientStayWhenAnotherLeaves) {
  Rovers s;
  s.build();
  Client client(s.port("rover_0/joints")), other(s.port("rover_0/joints"));
  ask(s, other, "set base 1 0 0");
  ask(s, client, "set base 0.5 0 0");
  other.close();
  for (int i = 0; i < 50; ++i) ask(s, client, "time");
  EXPECT_EQ(s.command().linear.x(), 0.5);
}

TEST(Setpoints, StopWhenTheyAreOlderThanTheTimeOut) {
  Rovers s(stream_at("tcp=0", {{"timeout", 0.2}}));
  s.build();
  Client client(s.port("rover_0/joints"));
  const double set_at = numbers_of(ask(s, client, "set base 0.5 0 0"))[0];
  client.say("wait 1\n");
  while (s.command().linear.x() != 0) s.run_for(0.001);
  const double stopped_at = 1e-9 * double(s.now());
  EXPECT_NEAR(stopped_at, set_at + 0.2, 0.002) << "the controller runs at 50 Hz, of which 0.2 s is a multiple";
  next_line(s, client);
  const double again_at = numbers_of(ask(s, client, "set base 0.25 0 0"))[0];
  while (1e-9 * double(s.now()) < again_at + 0.19) s.run_for(0.001);
  EXPECT_EQ(s.command().linear.x(), 0.25) << "a new setpoint counts";
}

TEST(Setpoints, OfPositionsStopWhereTheJointIs) {
  Arms s("position", 1, stream_at("tcp=0", {{"timeout", 0.1}}));
  s.build();
  Client client(s.port("arm_0/joints"));
  ask(s, client, "set all 1.5 0 0");
  s.run_for(0.3);
  const double stopped = s.position("shoulder");
  EXPECT_GT(stopped, 0.05);
  EXPECT_LT(stopped, 1);
  s.run_for(1);
  EXPECT_NEAR(s.position("shoulder"), stopped, 0.02);
  EXPECT_EQ(s.joint("shoulder", keys::joint_position_target), numbers_of(ask(s, client, "get all setpoint"))[1]);
}

TEST(Setpoints, StopAtOnceWhenAClientSaysStop) {
  Rovers s;
  s.build();
  Client client(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0 0.25");
  EXPECT_EQ(ask(s, client, "stop").substr(0, 3), "ok ");
  EXPECT_EQ(s.command().linear, Vec3::Zero());
  EXPECT_EQ(s.command().angular, Vec3::Zero());
}

TEST(Setpoints, AreClearedByAResetAndClientsStayConnected) {
  Rovers s(stream_at("tcp=0", {{"timeout", 0.5}}));
  s.build();
  const std::uint64_t fresh = s.state_hash();
  Client client(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0 0.25");
  client.say("wait 1000\nget base setpoint\n");
  s.run_for(0.2);
  ::usleep(100'000);  // by then both lines have arrived, also on a busy machine
  s.run_for(0.2);
  s.reset();
  EXPECT_EQ(s.state_hash(), fresh);
  EXPECT_EQ(next_line(s, client), "state 0 0 0 0") << "who waits is answered after the reset";
  EXPECT_EQ(next_line(s, client), "state 0 0 0 0");
  s.run_for(1);
  EXPECT_EQ(s.command().linear.x(), 0);
  EXPECT_EQ(ask(s, client, "set base 0.25 0 0").substr(0, 3), "ok ");
  EXPECT_EQ(s.command().linear.x(), 0.25);
}

TEST(Setpoints, AreThoseOfARestoredSnapshot) {
  Rovers s(stream_at("tcp=0", {{"timeout", 0.5}}));
  s.build();
  Client client(s.port("rover_0/joints"));
  const double set_at = numbers_of(ask(s, client, "set base 0.5 0 0"))[0];
  s.run_for(0.1);
  const Snapshot snapshot = s.snapshot();
  const std::uint64_t hash = s.state_hash();
  ask(s, client, "set base 3 0 0");
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  s.restore(snapshot);
  EXPECT_EQ(s.state_hash(), hash);
  EXPECT_EQ(s.command().linear.x(), 0.5);
  while (s.command().linear.x() != 0) s.run_for(0.001);
  EXPECT_NEAR(1e-9 * double(s.now()), set_at + 0.5, 0.002) << "their time-out counts on";
  EXPECT_NE(s.state_hash(), end);
}

TEST(Setpoints, OfASnapshotStopWhereTheirClientIsGone) {
  Rovers s;
  s.build();
  Client client(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0 0");
  const Snapshot snapshot = s.snapshot();
  client.close();
  ASSERT_TRUE(wire::run_until(s, [&] { return s.command().linear.x() == 0; }));
  s.restore(snapshot);
  EXPECT_EQ(s.command().linear.x(), 0.5);
  s.run_for(0.05);
  EXPECT_EQ(s.command().linear.x(), 0);
}

TEST(Setpoints, OfTwoRobotsAreTheirOwn) {
  Rovers s(stream_at("tcp=0"), 2);
  s.build();
  Client first(s.port("rover_0/joints")), second(s.port("rover_1/joints"));
  EXPECT_NE(s.port("rover_0/joints"), s.port("rover_1/joints"));
  ask(s, first, "set base 0.5 0 0");
  ask(s, second, "set base -0.25 0 0");
  EXPECT_EQ(s.command(0).linear.x(), 0.5);
  EXPECT_EQ(s.command(1).linear.x(), -0.25);
  first.close();
  ASSERT_TRUE(wire::run_until(s, [&] { return s.command(0).linear.x() == 0; }));
  EXPECT_EQ(s.command(1).linear.x(), -0.25);
}

}  // namespace
}  // namespace muro::joints
