// SPDX-License-Identifier: MIT
// controller.joints in real simulations, with clients on TCP.
#include <gtest/gtest.h>

#include <random>

#include "joints_testing.hpp"

namespace muro::joints {
namespace {

TEST(ControllerJoints, TellsItsGroupsWithUnitsAndLimits) {
  Arms s("position");
  s.build();
  Client client(s.port("arm_0/joints"));
  EXPECT_EQ(ask(s, client, "info"), "info joints 1 100 all");
  EXPECT_EQ(ask(s, client, "info all"),
            "info all 3 shoulder rad position rad -1.5 2 elbow rad position rad -1e+06 1e+06 slide m position m 0 0.5");
  EXPECT_EQ(ask(s, client, "info all velocity"),
            "info all 3 shoulder rad/s none - 0 0 elbow rad/s none - 0 0 slide m/s none - 0 0");
}

TEST(ControllerJoints, JointsReachThePositionsThatAreSet) {
  Arms s("position");
  s.build();
  Client client(s.port("arm_0/joints"));
  EXPECT_EQ(ask(s, client, "set all 0.5 -1.25 0.125").substr(0, 3), "ok ");
  s.run_for(2);
  EXPECT_NEAR(s.position("shoulder"), 0.5, 1e-6);
  const std::vector<double> state = numbers_of(ask(s, client, "get"));
  ASSERT_EQ(state.size(), 4u);
  EXPECT_NEAR(state[1], 0.5, 1e-6);
  EXPECT_NEAR(state[2], -1.25, 1e-6);
  EXPECT_NEAR(state[3], 0.125, 1e-6);
  EXPECT_EQ(numbers_of(ask(s, client, "get all setpoint"))[2], -1.25);
}

TEST(ControllerJoints, JointsOfMotionPointReachThePositionsThatAreSet) {
  wire::Served s;
  s.add("arm", arm_tree());
  s.use("motion.point", 1000, s.all_robots());
  s.use("controller.joints", 100, s.all_robots(), stream_at("tcp=0", {{"groups", Texts{"arm=shoulder,elbow"}}}));
  s.build();
  Client client(s.port("arm/joints"));
  EXPECT_EQ(ask(s, client, "set arm 0.5 -1.25").substr(0, 3), "ok ");
  s.run_for(0.5);
  EXPECT_NEAR(numbers_of(ask(s, client, "get"))[1], 0.5, 1e-12);
  EXPECT_SAYS(ask(s, client, "velocity arm 0 0"), "`shoulder` takes no velocity");
}

TEST(ControllerJoints, JointsTurnAtTheVelocityThatIsSet) {
  Arms s("velocity", 1, stream_at("tcp=0", {{"groups", Texts{"turn=elbow", "rest=sh*,slide"}}}));
  s.build();
  Client client(s.port("arm_0/joints"));
  const double begin = numbers_of(ask(s, client, "set turn 0.75"))[0];
  const std::vector<double> early = numbers_of(ask(s, client, "wait 0.5 turn"));
  const std::vector<double> late = numbers_of(ask(s, client, "wait 1 turn"));
  EXPECT_GE(early[0], begin + 0.5);
  EXPECT_NEAR(late[1] - early[1], 0.75 * (late[0] - early[0]), 1e-9);
  EXPECT_NEAR(numbers_of(ask(s, client, "get turn velocity"))[1], 0.75, 1e-12);
  const std::vector<double> rest = numbers_of(ask(s, client, "get rest"));
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest[1], 0);
  EXPECT_EQ(rest[2], 0);
}

TEST(ControllerJoints, ABaseDrivesVelocityTimesTime) {
  Rovers s;
  s.build();
  Client client(s.port("rover_0/joints"));
  EXPECT_EQ(ask(s, client, "info"), "info joints 1 50 base");
  EXPECT_EQ(ask(s, client, "info base"),
            "info base 3 vx m/s velocity m/s -1e+05 1e+05 vy m/s velocity m/s -1e+05 1e+05 wz rad/s velocity rad/s "
            "-1e+05 1e+05");
  const double begin = numbers_of(ask(s, client, "set base 0.5 -0.25 0"))[0];
  const double end = numbers_of(ask(s, client, "wait 2"))[0];
  EXPECT_NEAR(end - begin, 2.02, 0.0201);
  const double now = 1e-9 * double(s.now());
  EXPECT_NEAR(s.pose(*s.rovers[0]).position.x(), 0.5 * (now - begin), 1e-9);
  EXPECT_NEAR(s.pose(*s.rovers[0]).position.y(), -0.25 * (now - begin), 1e-9);
}

TEST(ControllerJoints, ABaseTellsItsVelocityInItsOwnAxes) {
  Rovers s(stream_at("tcp=0", {{"groups", Texts{"base=command.twist", "flight=command.twist.vz,command.twist.vx"}}}));
  s.build();
  Client client(s.port("rover_0/joints"));
  ask(s, client, "set base 0.5 0.25 1");
  EXPECT_EQ(ask(s, client, "set flight 2 0.5").substr(0, 3), "ok ");
  s.run_for(1.3);
  const std::vector<double> state = numbers_of(ask(s, client, "get base"));
  EXPECT_NEAR(state[1], 0.5, 1e-12);
  EXPECT_NEAR(state[2], 0.25, 1e-12);
  EXPECT_NEAR(state[3], 1, 1e-12);
  EXPECT_NEAR(numbers_of(ask(s, client, "get flight"))[1], 2, 1e-12);
}

TEST(ControllerJoints, FindsFramesOfBytesAfterGarbage) {
  Arms s("position", 1, stream_at("tcp=0", {{"protocol", "binary"}}));
  s.build();
  Client client(s.port("arm_0/joints"));
  const std::string time("\xa5\x5a\x07\x2a\x00\x00\x00\xce\xd2\x68\x82\xea", 12);
  client.say("hello\xa5\xa5\x5a" + time + std::string(3000, '\xa5') + time.substr(0, 11) + "x" + time);
  ASSERT_TRUE(wire::run_until(s, [&] { return client.heard().size() >= 40; }));
  s.run_for(0.1);
  const std::string replies = client.heard();
  ASSERT_EQ(replies.size(), 40u) << "two `time`";
  EXPECT_EQ(replies.substr(0, 4), "\xa5\x5a\x87\x2a");
  EXPECT_EQ(replies.substr(20, 4), "\xa5\x5a\x87\x2a");
}

TEST(ControllerJoints, AnswersAfterAnyRubbishInBothProtocols) {
  const std::string time_frame("\xa5\x5a\x07\x2a\x00\x00\x00\xce\xd2\x68\x82\xea", 12);
  for (const std::string protocol : {"text", "binary"}) {
    Arms s("position", 1, stream_at("tcp=0", {{"protocol", protocol}}));
    s.build();
    Client client(s.port("arm_0/joints"));
    std::mt19937 random(11);
    for (int i = 0; i < 400; ++i) {
      std::string rubbish(random() % 1024, ' ');
      for (char& c : rubbish) c = random() % 8 == 0 ? "\n\xa5\x5a\x03"[random() % 4] : char(random());
      client.say(rubbish);
      s.run_for(0.01);
      client.heard();
    }
    const bool is_text = protocol == "text";
    client.say((is_text ? "\n" : std::string(2060, '\0')) + (is_text ? "time 1\n" : time_frame));
    const std::string answer = is_text ? "error 2 `1` is a field too many: time\n" : "\xa5\x5a\x87\x2a";
    EXPECT_TRUE(wire::run_until(s, [&] { return client.heard().find(answer) != std::string::npos; })) << protocol;
    EXPECT_FALSE(client.is_closed());
  }
}

TEST(ControllerJoints, ReportsOfTwoRobotsComeUnasked) {
  Arms s("position", 2, stream_at("tcp=0", {{"report", 50.0}}));
  s.build();
  Client first(s.port("arm_0/joints")), second(s.port("arm_1/joints"));
  second.say("get\n");
  for (Client* client : {&first, &second}) {
    std::vector<double> times;
    while (times.size() < 20) {
      const std::string line = next_line(s, *client);
      if (line.starts_with("report")) times.push_back(std::stod(line.substr(7)));
    }
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_NEAR(times[i] - times[i - 1], 0.02, 1e-9);
  }
}

}  // namespace
}  // namespace muro::joints
