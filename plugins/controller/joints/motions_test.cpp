// SPDX-License-Identifier: MIT
// A client drives a vehicle in the same way under every motion.
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "joints_testing.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::joints {
namespace {

/// Drives 1 m ahead by ideal odometry and stops; then turns left by 90 degrees.
void drive_ahead_and_turn(std::uint16_t port) {
  Client client(port);
  double x = 0, yaw = 0, last = 0;
  const auto run = [&](const std::string& command, auto is_done) {
    for (int i = 0; i < 500 && !is_done(); ++i) {
      client.ask_running("set base " + command);
      const std::vector<double> state = numbers_of(client.ask_running("wait 0.02 base"));
      if (state.size() != 4) return;
      x += state[1] * (state[0] - last);
      yaw += state[3] * (state[0] - last);
      last = state[0];
    }
  };
  run("0.5 0 0", [&] { return x >= 1; });
  run("0 0 0.6", [&] { return yaw >= M_PI / 2; });
  client.ask_running("set base 0 0 0");
  client.ask_running("wait 1 base");
}

class OneClient : public testing::TestWithParam<std::string> {};

TEST_P(OneClient, DrivesAheadAndTurns) {
  wire::Served s;
  s.add_ground();
  const RobotTree model = s.read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
  const RobotView& rover = s.add("rover", model, {{0, 0, model.standing_height()}, Quat::Identity()});
  s.use(GetParam(), 500, s.all_robots());
  if (GetParam() != "motion.point") {
    s.use("drive.skid_steer", 0, s.all_robots());
    s.use_contacts();
  }
  s.use("controller.joints", 50, s.all_robots(), {{"stream", Texts{"tcp=0", "lockstep=driver", "timeout=20"}}});
  s.build();
  std::thread driver(drive_ahead_and_turn, s.port("rover/joints"));
  s.run_for(14);
  driver.join();
  EXPECT_NEAR(s.pose(rover).position.x(), 1, 0.1);
  EXPECT_NEAR(s.pose(rover).position.y(), 0, 0.1);
  const Vec3 ahead = s.pose(rover).orientation * Vec3::UnitX();
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), M_PI / 2, 0.1);
}

std::vector<std::string> motions() {
  std::vector<std::string> found;
  for (const CatalogEntry& e : test::plugins().catalog())
    for (const char* id : {"motion.point", "motion.simplified", "motion.bullet"})
      if (e.id == id) found.emplace_back(id);
  return found;
}

INSTANTIATE_TEST_SUITE_P(Motions, OneClient, testing::ValuesIn(motions()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

TEST(PythonClient, SwingsTheJointsByFramesOfBytes) {
  if (std::system("python3 -c 'import socket, struct, zlib'") != 0) GTEST_SKIP() << "needs python3";
  Arms s("position", 1,
         {{"stream", Texts{"tcp=0", "lockstep=swing", "timeout=20"}},
          {"protocol", "binary"},
          {"groups", Texts{"arm=shoulder,elbow"}}});
  s.build();
  const std::string command =
      "python3 " MURO_TEST_SOURCE_DIR "/plugins/controller/joints/client.py " + std::to_string(s.port("arm_0/joints"));
  std::string output;
  int status = -1;
  std::thread swing([&] {
    FILE* const pipe = ::popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    char buffer[4096];
    for (std::size_t size = 0; (size = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, size);
    status = ::pclose(pipe);
  });
  double greatest = 0;
  for (int i = 0; i < 50; ++i) {
    s.run_for(0.02);
    greatest = std::max(greatest, s.position("elbow"));
  }
  s.run_for(0.1);
  swing.join();
  EXPECT_EQ(status, 0) << output;
  EXPECT_EQ(output.substr(0, 22), "joints 1 100 arm\n0.020") << output;
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 51) << output;
  EXPECT_NEAR(greatest, 0.2, 0.02) << "0.2 sin(pi t)";
  EXPECT_NEAR(s.position("elbow"), 0.2 * std::sin(M_PI * 0.98), 0.02);
}

}  // namespace
}  // namespace muro::joints
