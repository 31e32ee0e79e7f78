// SPDX-License-Identifier: MIT
// controller.sensors in real simulations, with clients on TCP.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "plugins/controller/common/wire_protocol/dialogue_testing.hpp"
#include "plugins/controller/common/wire_protocol/frame.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro::sensors {
namespace {

using wire::ask;
using wire::Client;
using wire::numbers_of;
using wire::Settings;
using wire::Texts;

/// Balls that motion.point moves. Each has a laser of 5 rays that points at a wall, 3 m ahead of the first ball.
struct Scouts : wire::Served {
  explicit Scouts(int count = 1) {
    const Shape wall = Shape::box({0.2, 20, 4});
    world().add_scenery("wall", {{3.1, 0, 0}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
    for (int i = 0; i < count; ++i) {
      const RobotView& scout = add("scout_" + std::to_string(i),
                                   test::single_body(Shape::sphere(0.05), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}),
                                   {{-0.5 * i, 2.0 * i, 0}, Quat::Identity()}, {{0.1, 0, 0}, Vec3::Zero()});
      lasers.push_back({&scout, add_sensor_object(scout, "laser", scout.base())});
    }
    use("motion.point", 1000, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    use("laser.raycast", 100, lasers,
        {{"min_angle", -0.5}, {"max_angle", 0.5}, {"rays", std::int64_t(5)}, {"max_range", 10.0}});
  }
  void serve(Texts groups, Settings settings = {}, double rate = 100) {
    settings["stream"] = Texts{"tcp=0"};
    settings["groups"] = std::move(groups);
    use("controller.sensors", rate, all_robots(), std::move(settings));
  }
  std::vector<Item> lasers;
};

TEST(ControllerSensors, GivesWhatALaserMeasures) {
  Scouts s;
  s.serve({"scan=laser:ranges", "body=body:pose,body:twist"});
  s.build();
  Client client(s.port("scout_0/sensors"));
  EXPECT_EQ(ask(s, client, "info"), "info sensors 1 100 scan body");
  EXPECT_EQ(ask(s, client, "info scan"), "info scan 1 laser:ranges m 5 -");
  EXPECT_EQ(ask(s, client, "info body"),
            "info body 2 body:pose m 7 x,y,z,qx,qy,qz,qw body:twist m/s,rad/s 6 vx,vy,vz,wx,wy,wz");
  const std::vector<double> scan = numbers_of(ask(s, client, "get"));
  ASSERT_EQ(scan.size(), 6u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(scan[std::size_t(i) + 1], 3 / std::cos(0.25 * (i - 2)), 1e-9) << i;
  const std::vector<double> body = numbers_of(ask(s, client, "wait 0.1 body"));
  EXPECT_EQ(body.size(), 14u);
  EXPECT_EQ(body[7], 1) << "qw";
}

TEST(ControllerSensors, GivesTheReadingOfTheDeviceUnlessTheTrueOneIsNamed) {
  Scouts s;
  s.use("sensor.error", 0, s.lasers, {{"sigma", 0.0}, {"resolution", 0.5}});
  s.serve({"measured=ranges", "true=laser:ranges"});
  s.build();
  Client client(s.port("scout_0/sensors"));
  const std::vector<double> measured = numbers_of(ask(s, client, "get measured"));
  const std::vector<double> truth = numbers_of(ask(s, client, "get true"));
  EXPECT_EQ(ask(s, client, "info measured"), "info measured 1 laser:ranges.measured m 5 -");
  ASSERT_EQ(measured.size(), 6u);
  EXPECT_EQ(measured[1], 3.5);
  EXPECT_NEAR(truth[1], 3 / std::cos(0.5), 1e-9);
}

TEST(ControllerSensors, GivesEachRobotItsOwnAndOthersByTheirNames) {
  Scouts s(2);
  s.serve({"own=body:pose", "other=scout_1/body:pose", "all=scout_?/body:pose"});
  s.build();
  Client first(s.port("scout_0/sensors")), second(s.port("scout_1/sensors"));
  EXPECT_EQ(numbers_of(ask(s, first, "get own"))[2], 0);
  EXPECT_EQ(numbers_of(ask(s, second, "get own"))[2], 2);
  EXPECT_EQ(numbers_of(ask(s, first, "get other"))[2], 2);
  EXPECT_EQ(numbers_of(ask(s, second, "get all")).size(), 15u);
  EXPECT_EQ(ask(s, first, "info all"),
            "info all 2 scout_0/body:pose m 7 x,y,z,qx,qy,qz,qw scout_1/body:pose m 7 x,y,z,qx,qy,qz,qw");
}

TEST(ControllerSensors, ServesTheWholeScene) {
  Scouts s(2);
  s.use("controller.sensors", 50, {},
        {{"stream", Texts{"tcp=0"}}, {"groups", Texts{"g=world:gravity,scout_1/laser:ranges"}}});
  s.build();
  Client client(s.port("world/sensors"));
  const std::vector<double> numbers = numbers_of(ask(s, client, "get"));
  ASSERT_EQ(numbers.size(), 9u);
  EXPECT_EQ(numbers[3], -9.81);
  EXPECT_NEAR(numbers[6], 3.5, 1e-9);
}

TEST(ControllerSensors, OnlyReads) {
  Scouts s;
  s.serve({"scan=laser:ranges"});
  s.build();
  Client client(s.port("scout_0/sensors"));
  EXPECT_EQ(ask(s, client, "set scan 1 1 1 1 1"), "error 7 group `scan` is a group of readings, which are not set");
  EXPECT_EQ(ask(s, client, "stop"), "error 7 group `scan` is a group of readings, which do not stop");
  EXPECT_EQ(ask(s, client, "get scan velocity"), "error 7 group `scan` is read without a quantity");
  EXPECT_EQ(ask(s, client, "get scn"), "error 3 no group `scn` (did you mean `scan`?); there are: `scan`");
}

TEST(ControllerSensors, ReportsScansAsFramesOfBytes) {
  Scouts s;
  s.serve({"scan=laser:ranges"}, {{"protocol", "binary"}, {"report", 10.0}});
  s.build();
  Client client(s.port("scout_0/sensors"));
  constexpr std::size_t size = 12 + 12 + 5 * 4;
  ASSERT_TRUE(wire::run_until(s, [&] { return client.heard().size() >= 3 * size; }));
  std::int64_t last = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string bytes = client.heard().substr(i * size, size);
    const auto frame = wire::read_frame(bytes);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->type, 131);
    EXPECT_EQ(frame->sequence, i);
    std::int64_t time = 0;
    float ahead = 0;
    std::memcpy(&time, frame->payload.data(), sizeof time);
    std::memcpy(&ahead, frame->payload.data() + 12 + 2 * 4, sizeof ahead);
    EXPECT_EQ(time - last, i > 0 ? 100'000'000 : time);
    last = time;
    EXPECT_NEAR(ahead, 3, 1e-6);
  }
}

TEST(ControllerSensors, ChangesNoBitOfARun) {
  std::uint64_t hashes[2] = {};
  for (const bool is_served : {false, true}) {
    Scouts s(2);
    if (is_served) s.serve({"scan=laser:ranges", "body=body:*"});
    s.build();
    if (is_served) {
      Client client(s.port("scout_1/sensors"));
      client.say("report 100 body\nwait 0.3 scan\n");
      EXPECT_EQ(wire::next_line(s, client).substr(0, 3), "ok ");
    }
    s.run_until(1'000'000'000);
    hashes[is_served ? 1 : 0] = s.state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(ControllerSensors, WaitsInLockstepForItsClient) {
  Scouts s;
  s.use("controller.sensors", 50, s.all_robots(),
        {{"stream", Texts{"tcp=0", "lockstep=watcher", "timeout=20"}}, {"groups", Texts{"scan=ranges"}}});
  s.build();
  std::vector<double> times;
  std::thread watcher([&] {
    Client client(s.port("scout_0/sensors"));
    for (int i = 0; i < 10; ++i) {
      times.push_back(numbers_of(client.ask_running("get"))[0]);
      ::usleep(500);
      times.push_back(numbers_of(client.ask_running("wait 0.1"))[0]);
    }
  });
  s.run_for(1.2);
  watcher.join();
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(times[2 * i], 0.1 * double(i), 1e-12);
    EXPECT_NEAR(times[2 * i + 1], 0.1 * double(i + 1), 1e-12);
  }
}

std::string refusal_of_groups(Texts groups, Settings settings = {}) {
  return test::complaint_of<SetupError>([&] {
    Scouts s;
    s.serve(std::move(groups), std::move(settings));
    s.build();
  });
}

TEST(SetUpOfSensors, RefusesWhatCannotBeRead) {
  EXPECT_SAYS(refusal_of_groups({}), "`groups` must say what clients read");
  EXPECT_SAYS(refusal_of_groups({"a=laser:rnges"}),
              "`groups`: group `a`: no property matches `laser:rnges` (did you mean `laser:ranges`?)");
  EXPECT_SAYS(refusal_of_groups({"a=rangs"}), "no property matches `rangs` (did you mean `ranges`?)");
  EXPECT_SAYS(
      refusal_of_groups({"a=body:collision.shapes"}),
      "`body:collision.shapes` gives nothing to read: `body:collision.shapes` is of type muro.Shape, which has no "
      "numbers");
  EXPECT_SAYS(refusal_of_groups({"a=body:inert*"}), "does not change");
  EXPECT_SAYS(refusal_of_groups({"a b=ranges"}), "must begin with a name");
}

TEST(SetUpOfSensors, RefusesGroupsThatAFrameHasNoRoomFor) {
  const std::string complaint = test::complaint_of<SetupError>([] {
    Scouts s;
    const std::vector<double> many(9000);
    s.world().set_array(s.lasers[0].object, Key<double>{"spectrum", "1", "many numbers"},
                        std::span<const double>(many));
    s.serve({"all=laser:spectrum"}, {{"protocol", "binary"}});
    s.build();
  });
  EXPECT_SAYS(complaint, "group `all` has 9000 numbers, and a message of this protocol has room for 8190; divide it");
}

}  // namespace
}  // namespace muro::sensors
