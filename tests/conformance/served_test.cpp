// SPDX-License-Identifier: MIT
// Requirements on every controller that serves clients on a stream, with any protocol: it has a parameter `stream`.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "core/external/input_log.hpp"
#include "tests/conformance/team.hpp"
#include "tests/support/files.hpp"
#include "tests/support/peer.hpp"

namespace muro {
namespace {

/// Returns the algorithms of kind controller with a parameter `stream`.
std::vector<std::string> served_controllers() {
  std::vector<std::string> some;
  for (const std::string& id : test::algorithms_of("controller")) {
    const auto& parameters = test::plugins().algorithm(id).description->parameters;
    if (std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.name == "stream"; }))
      some.push_back(id);
  }
  return some;
}

/// A rover with a laser scanner and the controller, on a TCP port of its own.
struct Served : test::Scene {
  const RobotView* rover = nullptr;
  std::uint16_t port = 0;  ///< 0: nothing is open

  explicit Served(const std::string& controller, const std::string& recording = "", const std::string& replay = "") {
    add_ground();
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
    rover = &add("rover", model, {{0, 0, model.standing_height()}, Quat::Identity()});
    use("motion.differential_drive", 100, all_robots());
    use("drive.skid_steer", 0, all_robots());
    use_contacts();
    const Item laser{rover, add_sensor_object(*rover, "laser", world().object("rover/laser_link"))};
    use("laser.raycast", 10, {laser},
        {{"rays", std::int64_t(682)}, {"min_angle", -2.0862}, {"max_angle", 2.0924}, {"max_range", 5.6}});
    std::map<std::string, ParameterInput> settings{{"stream", std::vector<std::string>{"tcp=0"}}};
    if (controller == "controller.sensors") settings["groups"] = std::vector<std::string>{"laser=ranges"};
    const bool is_global = controller == "controller.jsonrpc";
    use(controller, 100,
        is_global ? std::vector<Item>{}
                  : std::vector<Item>{controller == "controller.scip2" ? laser : Item{rover, rover->base()}},
        settings);
    if (!recording.empty()) use("recorder.inputs", 10, {}, {{"file", recording}});
    if (!replay.empty()) use("controller.replay", 10, {}, {{"file", replay}});
    set_log([this](LogLevel, std::string_view line) {
      if (const std::uint16_t told = test::tcp_port_in(line); told != 0) port = told;
    });
  }
  void drive() {
    build();
    world().value(rover->base(), keys::command_twist) = {{0.5, 0, 0}, {0, 0, 0.1}};
  }
};

/// Sends the bytes of a client that knows no protocol, and gives them time to arrive.
void say(const test::Peer& stranger, const std::string& bytes) {
  static_cast<void>(stranger.say(bytes));  // the server may have closed the connection
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Returns bytes of all values, in lines of different lengths.
std::string rubbish(unsigned seed, std::size_t size) {
  std::mt19937 random(seed);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += random() % 40 == 0 ? '\n' : char(random());
  return bytes;
}

class EveryServedController : public testing::TestWithParam<std::string> {};

TEST_P(EveryServedController, OpensNothingWhereAScenarioIsOnlyLookedAt) {
  Served s(GetParam());
  s.keep_outputs_closed();
  s.build();
  EXPECT_EQ(s.port, 0);
}

TEST_P(EveryServedController, LetsNoStrangerDisturbARobot) {
  Served alone(GetParam());
  alone.drive();
  alone.run_for(1);
  Served s(GetParam());
  s.drive();
  ASSERT_NE(s.port, 0);
  for (unsigned i = 0; i < 20; ++i) {
    test::Peer stranger = test::Peer::tcp(s.port);
    say(stranger, rubbish(i, 5000));
    s.run_for(0.05);
    if (i % 2 == 0) stranger.reset();
  }
  EXPECT_EQ(s.now(), alone.now());
  if (GetParam() != "controller.jsonrpc") {  // which closes the connection, and records only the effects of requests
    EXPECT_GT(s.inputs().count(), 20u) << "what they say is heard";
  }
  EXPECT_EQ(s.pose(*s.rover).position, alone.pose(*alone.rover).position);
  EXPECT_GE(test::Peer::tcp(s.port).fd, 0) << "it still serves";
}

TEST_P(EveryServedController, IsFreshAfterAReset) {
  Served s(GetParam());
  s.drive();
  s.run_for(0.2);
  s.reset();
  const std::uint64_t before = s.state_hash();
  const test::Peer stranger = test::Peer::tcp(s.port);
  for (int i = 0; i < 10; ++i) {
    say(stranger, rubbish(7, 500));
    s.run_for(0.02);
  }
  s.reset();
  EXPECT_EQ(s.state_hash(), before);
  EXPECT_GE(test::Peer::tcp(s.port).fd, 0);
}

TEST_P(EveryServedController, IsReplayedToTheSameBitsWithoutItsClients) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("inputs.csv");
  std::uint64_t hash = 0;
  {
    Served s(GetParam(), file);
    s.drive();
    for (unsigned i = 0; i < 10; ++i) {
      const test::Peer stranger = test::Peer::tcp(s.port);
      say(stranger, rubbish(100 + i, 300));
      s.run_for(0.05);
    }
    hash = s.state_hash();
    s.finish();
  }
  Served s(GetParam(), "", file);
  s.drive();
  EXPECT_EQ(s.port, 0) << "nothing is opened";
  s.run_for(0.5);
  s.finish();
  EXPECT_EQ(s.state_hash(), hash);
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryServedController, testing::ValuesIn(served_controllers()), test::name_of);

}  // namespace
}  // namespace muro
