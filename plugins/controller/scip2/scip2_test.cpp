// SPDX-License-Identifier: MIT
// The plugin in the complete simulator: clients on TCP, lasers of the scene.
#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include <cmath>
#include <memory>
#include <thread>

#include "scip2_testing.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/peer.hpp"
#include "tests/support/scene.hpp"

namespace muro::scip2 {
namespace {

using Settings = std::map<std::string, ParameterInput>;
using Texts = std::vector<std::string>;
using test::Peer;

/// Robots that do not move in a room of 6 m by 4 m, each with a laser of 682 rays.
struct Room : test::Scene {
  explicit Room(int robots = 1) {
    add_ground();
    wall("east", Shape::box({0.2, 4.4, 3}), {3.1, 0, 1.5});
    wall("west", Shape::box({0.2, 4.4, 3}), {-3.1, 0, 1.5});
    wall("north", Shape::box({6.4, 0.2, 3}), {0, 2.1, 1.5});
    for (int i = 0; i < robots; ++i) {
      const RobotView& robot = add("rover_" + std::to_string(i),
                                   test::single_body(Shape::sphere(0.001), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}),
                                   {{0.02 * i - 1, -0.3 + 0.01 * (i % 7), 0.5 + 0.003 * i}, Quat::Identity()});
      lasers.push_back({&robot, add_sensor_object(robot, "laser", robot.base())});
    }
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
  }
  void wall(const std::string& name, const Shape& shape, const Vec3& at) {
    world().add_scenery(name, {at, Quat::Identity()}, std::span<const Shape>(&shape, 1));
  }
  void use_laser(Settings settings = {}) {
    const Model m = urg_04lx();
    settings.merge(Settings{{"min_angle", m.angle_of(44)},
                            {"max_angle", m.angle_of(725)},
                            {"rays", std::int64_t(682)},
                            {"min_range", 0.02},
                            {"max_range", 5.6}});
    use("laser.raycast", 10, lasers, settings);
  }
  void use_device(Settings settings = {}, double rate = 200) {
    if (!settings.contains("stream")) settings["stream"] = Texts{"tcp=0"};
    use("controller.scip2", rate, lasers, std::move(settings));
  }
  void build() {
    set_log([this](LogLevel, std::string_view text) { log += std::string(text) + "\n"; });
    Scene::build();
  }
  /// Connects to the port of a stream, which the log reports.
  Peer connect(const std::string& stream = "rover_0/laser") const {
    const std::uint16_t port = test::tcp_port_in(log, stream);
    EXPECT_NE(port, 0) << log;
    return Peer::tcp(port);
  }
  /// Runs a step of 5 ms, and waits for the I/O thread.
  void go(double seconds = 0.005) {
    run_for(seconds);
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  /// Returns the device's replies to `lines`, up to `count` complete ones.
  std::vector<Reply> ask(Peer& client, const std::string& lines, std::size_t count = 1) {
    client.heard.clear();
    EXPECT_TRUE(client.say(lines));
    for (int i = 0; i < 2000; ++i) {
      const auto replies = replies_in(client.hear());
      if (replies && replies->size() >= count) return *replies;
      go();
    }
    ADD_FAILURE() << "no " << count << " replies to " << lines << " but " << client.heard;
    return std::vector<Reply>(count);
  }
  std::vector<double> ranges(std::size_t robot, const Key<double>& key = keys::ranges) {
    const auto found = world().values(lasers[robot].object, key);
    return {found.begin(), found.end()};
  }
  std::vector<Item> lasers;
  std::string log;
};

void expect_equal(const std::vector<long>& millimetres, const std::vector<double>& ranges, double max_range = 5.6) {
  ASSERT_EQ(millimetres.size(), ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] >= max_range)
      EXPECT_LT(millimetres[i], 20) << i;
    else
      EXPECT_NEAR(double(millimetres[i]), 1e3 * ranges[i], 0.501) << i;
  }
}

TEST(Scip2, ScansAreThoseOfTheLaserToTheMillimetre) {
  Room s;
  s.use_laser();
  s.use_device();
  s.build();
  Peer client = s.connect();
  EXPECT_EQ(s.ask(client, "SCIP2.0\n")[0].echo, "SCIP2.0");
  EXPECT_EQ(s.ask(client, "BM\n")[0].status, "00");
  const Reply scan = s.ask(client, "GD0044072501\n")[0];
  EXPECT_TRUE(scan.sums_are_right);
  const std::vector<double> truth = s.ranges(0);
  expect_equal(scan.values(3), truth);
  EXPECT_LT(*std::min_element(truth.begin(), truth.end()), 2.5) << "there is something to see";
  const auto scans = s.ask(client, "MS0044072501003\n", 4);
  EXPECT_EQ(scans[3].echo, "MS0044072501000");
  EXPECT_EQ(scans[3].timestamp() - scans[1].timestamp(), 200);
  EXPECT_EQ(s.ask(client, "ME0044072501101\n", 2)[1].values(3).size(), 2 * 682u);
}

TEST(Scip2, WhatTheDeviceMeasuresIsSentWhereThereIsNoise) {
  Room s;
  s.use_laser();
  s.use("sensor.error", 10, s.lasers, {{"bias", 0.25}});
  s.use_device();
  s.build();
  Peer client = s.connect();
  s.ask(client, "BM\n");
  const std::vector<long> values = s.ask(client, "GD0044072501\n")[0].values(3);
  const std::vector<double> truth = s.ranges(0);
  ASSERT_LT(truth[600], 5);
  EXPECT_NEAR(double(values[600]), 1e3 * truth[600] + 250, 0.501);
}

TEST(Scip2, TwoClientsOnTwoScannersAtOnce) {
  Room s(2);
  s.use_laser();
  s.use_device();
  s.build();
  Peer a = s.connect(), b = s.connect("rover_1/laser");
  a.say("BM\nMD0044072501000\n");
  b.say("MD0044072501005\n");
  for (int i = 0; i < 400; ++i) s.go();
  const auto to_a = replies_in(a.hear()), to_b = replies_in(b.hear());
  ASSERT_TRUE(to_a && to_b);
  EXPECT_GE(to_a->size(), 17u);
  EXPECT_EQ(to_b->size(), 6u);
  expect_equal(to_a->back().values(3), s.ranges(0));
  expect_equal(to_b->back().values(3), s.ranges(1));
  EXPECT_NE(s.ranges(0), s.ranges(1));
}

TEST(Scip2, ASweptLaserAndOneOfManyRaysAreReadByAngle) {
  for (const bool is_swept : {false, true}) {
    Room s;
    s.use("laser.raycast", is_swept ? 200 : 10, s.lasers,
          {{"rays", std::int64_t(4096)}, {"max_range", 8.0}, {"sweep_steps", std::int64_t(is_swept ? 20 : 1)}});
    s.use_device();
    s.build();
    Peer client = s.connect();
    s.ask(client, "BM\n");
    const std::vector<long> values = s.ask(client, "GD0384038401\n")[0].values(3);
    EXPECT_NEAR(double(values[0]), 4000, 1) << "the wall ahead";
    EXPECT_NEAR(double(s.ask(client, "GD0640064001\n")[0].values(3)[0]), 2300, 1) << "90 degrees to the left";
  }
}

TEST(Scip2, AUst10LxServes1081StepsFortyTimesASecond) {
  Room s;
  const Model m = ust_10lx();
  s.use("laser.raycast", 40, s.lasers,
        {{"min_angle", m.angle_of(0)},
         {"max_angle", m.angle_of(1080)},
         {"rays", std::int64_t(1081)},
         {"max_range", 31.0}});
  s.use_device({{"model", "ust-10lx"}, {"serial", "H1234567"}});
  s.build();
  Peer client = s.connect();
  EXPECT_EQ(s.ask(client, "VV\n")[0].lines[4], "SERI:H1234567;" + std::string(1, expected_sum("SERI:H1234567")));
  const auto scans = s.ask(client, "MD0000108001010\n", 11);
  EXPECT_EQ(scans[10].timestamp() - scans[1].timestamp(), 9 * 25);
  const std::vector<long> values = scans[10].values(3);
  const std::vector<double> truth = s.ranges(0);
  ASSERT_EQ(values.size(), truth.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (truth[i] >= 31)
      EXPECT_EQ(values[i], 65533);
    else
      EXPECT_NEAR(double(values[i]), 1e3 * truth[i], 0.501);
  }
}

TEST(Scip2, ADriverForSerialPortsOpensAPseudoTerminal) {
  Room s;
  s.use_laser();
  const std::string path = "/tmp/muro-scip2-test-" + std::to_string(getpid());
  s.use_device({{"stream", Texts{"pty=" + path}}});
  s.build();
  Peer client = Peer::file(path);
  for (const char* command : {"QT\n", "SS115200\n", "SCIP2.0\n", "BM\n"}) EXPECT_EQ(s.ask(client, command).size(), 1u);
  expect_equal(s.ask(client, "GD0044072501\n")[0].values(3), s.ranges(0));
  client.close();
  for (int i = 0; i < 200; ++i) s.go();
  Peer other = Peer::file(path);
  EXPECT_NE(s.ask(other, "II\n")[0].lines[4].find("115200"), std::string::npos) << "the device stayed on";
}

/// A terminal replaces the serial device; its master reports the rate.
TEST(Scip2, ASerialDeviceRunsAtTheRateThatTheRepliesTell) {
  Peer line(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  ::grantpt(line.fd);
  ::unlockpt(line.fd);
  Room s;
  s.use_laser();
  s.use_device({{"stream", Texts{"serial=" + std::string(::ptsname(line.fd)), "baud=115200"}}, {"start", "scip2.0"}});
  s.build();
  const auto expect = [&](const char* command, const char* status, speed_t speed) {
    EXPECT_EQ(s.ask(line, std::string(command) + "\n")[0].status, status) << command;
    const auto is_set = [&] {
      termios settings{};
      return ::tcgetattr(line.fd, &settings) == 0 && ::cfgetospeed(&settings) == speed;
    };
    for (int i = 0; i < 1000 && !is_set(); ++i) s.go();
    EXPECT_TRUE(is_set()) << command;
  };
  EXPECT_NE(s.ask(line, "II\n")[0].lines[4].find("SBPS:115200[bps]<-Default"), std::string::npos);
  expect("SS115200", "03", B115200);
  expect("SS019200", "00", B19200);
  expect("SS019200", "03", B19200);
  expect("SS038400", "00", B38400);
  expect("SS019200", "00", B19200);
  expect("RS", "00", B115200);
  expect("SS115200", "03", B115200);
}

TEST(Scip2, ATimedLineRunsAtTheRateThatTheRepliesTell) {
  Room s;
  s.use_laser();
  s.use_device({{"stream", Texts{"tcp=0", "timed=true", "baud=115200"}}, {"start", "scip2.0"}, {"reply_grid", 0.0}});
  s.build();
  Peer client = s.connect();
  EXPECT_EQ(s.ask(client, "SS115200\n")[0].status, "03");
  EXPECT_EQ(s.ask(client, "SS038400\n")[0].status, "00");
  EXPECT_EQ(s.ask(client, "SS019200\n")[0].status, "00");
  const std::int64_t begin = s.now();
  s.ask(client, "VV\n");
  EXPECT_GT(double(s.now() - begin), 70e6) << "about 150 bytes: 78 ms at 19200 bit/s, 13 ms at 115200";
  EXPECT_EQ(s.ask(client, "RS\n")[0].status, "00");
  EXPECT_EQ(s.ask(client, "SS115200\n")[0].status, "03");
}

TEST(Scip2, SeveralDevicesMayReportOneLaser) {
  Room s;
  s.use_laser();
  s.use_device();
  s.use_device({{"reply_grid", 0.0}});
  s.build();
  Peer a = s.connect(), b = s.connect("rover_0/laser.2");
  EXPECT_EQ(s.ask(a, "BM\n")[0].status, "00");
  EXPECT_EQ(s.ask(b, "GD0044072501\n")[0].status, "10") << "it has a laser and a session of its own";
}

TEST(Scip2, AResetIsAPowerCycle) {
  for (const bool keeps : {false, true}) {
    Room s;
    s.use_laser();
    s.use_device({{"session", keeps ? "keep" : "power_cycle"}});
    s.build();
    const std::uint64_t fresh = s.state_hash();
    Peer client = s.connect();
    EXPECT_EQ(s.ask(client, "BM\n")[0].status, "00");
    const long before = s.ask(client, "GD0044072501\n")[0].timestamp();
    s.run_for(2);
    s.reset();
    EXPECT_EQ(s.state_hash(), fresh);
    if (keeps) {
      EXPECT_EQ(s.ask(client, "BM\n")[0].status, "02");
      EXPECT_GT(s.ask(client, "GD0044072501\n")[0].timestamp(), before + 1900);
      EXPECT_SAYS(s.log, "session: keep: devices go on as they were before the reset, which is no fresh start");
    } else {
      EXPECT_EQ(s.ask(client, "GD0044072501\n")[0].status, "10");
      EXPECT_EQ(s.ask(client, "BM\n")[0].status, "00");
      EXPECT_LT(s.ask(client, "GD0044072501\n")[0].timestamp(), 1000);
    }
  }
}

TEST(Scip2, ASnapshotHoldsTheDevice) {
  Room s;
  s.use_laser();
  s.use_device();
  s.build();
  Peer client = s.connect();
  s.ask(client, "MD0044072501000\n", 3);
  const Snapshot middle = s.snapshot();
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end);
  EXPECT_EQ(s.ask(client, "QT\n")[0].sums_are_right, true);
}

/// The client acts as `printf 'SCIP2.0\\nVV\\n' | nc -N`.
TEST(Scip2, AClientThatClosesItsSideGetsItsRepliesAndIsDisconnected) {
  Room s;
  s.use_laser();
  s.use_device();
  s.build();
  Peer client = s.connect();
  ASSERT_TRUE(client.say("SCIP2.0\nVV\n"));
  client.end();
  for (int i = 0; i < 200 && !client.is_closed; ++i) {
    s.go();
    client.hear();
  }
  EXPECT_TRUE(client.is_closed);
  EXPECT_NE(client.heard.find("VV\n00P\n"), std::string::npos) << client.heard;
}

TEST(Scip2, RepliesThatAreOnTheirWayWhenTheRunEndsComeOnce) {
  for (int i = 0; i < 200; ++i) {
    auto s = std::make_unique<Room>();
    s->use_laser();
    s->use_device({{"start", "scip2.0"}, {"reply_grid", 0.0}});
    s->build();
    Peer client = s->connect();
    ASSERT_TRUE(client.say("VV\n"));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    s->run_for(0.01);
    s.reset();
    client.hear();
    ASSERT_EQ(client.heard.find("VV"), client.heard.rfind("VV")) << client.heard;
  }
}

/// The client has no clock. No simulated time passes between two of its requests, even when it waits long.
TEST(Scip2, TimeWaitsForAClientInLockstep) {
  Room s;
  s.use_laser();
  s.use_device({{"stream", Texts{"tcp=0", "lockstep=driver"}}});
  s.build();
  std::vector<long> timestamps;
  Peer client = s.connect();
  std::thread driver([&] {
    const auto ask = [&](const std::string& line) {
      client.heard.clear();
      client.say(line);
      while (client.heard.size() < 2 || client.heard.substr(client.heard.size() - 2) != "\n\n") client.hear();
      return replies_in(client.heard).value().back();
    };
    ask("BM\n");
    for (int i = 0; i < 10; ++i) {
      timestamps.push_back(ask("GD0384038401\n").timestamp());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    client.close();
  });
  s.run_for(3);
  driver.join();
  for (std::size_t i = 1; i < timestamps.size(); ++i) EXPECT_EQ(timestamps[i] - timestamps[i - 1], 100);
}

TEST(Scip2, AHundredScannersServeAHundredClients) {
  Room s(100);
  s.use_laser();
  s.use_device();
  s.build();
  std::vector<Peer> clients;
  for (int i = 0; i < 100; ++i) clients.push_back(s.connect("rover_" + std::to_string(i) + "/laser"));
  for (Peer& c : clients) ASSERT_TRUE(c.say("MD0044072501000\n"));
  for (int i = 0; i < 240; ++i) {
    s.go();
    for (Peer& c : clients) c.hear();
  }
  for (std::size_t i = 0; i < clients.size(); ++i) {
    const auto replies = replies_in(clients[i].hear());
    ASSERT_TRUE(replies.has_value());
    ASSERT_GE(replies->size(), 9u);
    expect_equal(replies->back().values(3), s.ranges(i));
  }
}

TEST(Scip2, GarbageOnAStreamIsAnsweredAndForgotten) {
  Room s;
  s.use_laser();
  s.use_device();
  s.build();
  Peer client = s.connect();
  std::string garbage;
  for (int i = 0; i < 5000; ++i) garbage += char(i * 7919 % 251);
  client.say(garbage + std::string(3000, 'x') + "\r\n");
  for (int i = 0; i < 100; ++i) s.go();
  EXPECT_TRUE(replies_in(client.hear()).has_value());
  EXPECT_EQ(s.ask(client, "QT\r\n")[0].status, "00");
}

TEST(Scip2, RefusesWhatCannotBe) {
  const auto refusal = [](Settings settings, const Settings& laser = {}, bool has_laser = true) {
    Room s;
    if (has_laser) s.use_laser(laser);
    s.use_device(std::move(settings));
    return test::complaint_of([&] { s.build(); });
  };
  EXPECT_SAYS(refusal({{"dmin", std::int64_t(6000)}}), "dmin (6000) must be less than dmax (5600)");
  EXPECT_SAYS(refusal({{"amin", std::int64_t(800)}}), "amin (800) must not be greater than amax (725)");
  EXPECT_SAYS(refusal({{"ares", std::int64_t(500)}}), "there are 682 steps from amin (44) to amax (725), more than in");
  EXPECT_SAYS(refusal({{"serial", "a;b"}}), "serial is `a;b`; it must be at most 56 printable ASCII characters");
  EXPECT_SAYS(refusal({{"model", "urg-05lx"}}), "urg-05lx");
  EXPECT_SAYS(refusal({}, {}, false), "robot `rover_0` has no laser for the device to report; give it one");
  EXPECT_SAYS(refusal({}, {{"min_angle", 2.5}, {"max_angle", 3.0}}),
              "no ray of `rover_0/laser` looks where the 682 steps of the device look; give the laser min_angle: "
              "-2.086214, max_angle: 2.092350, rays: 682");
  Room slow;
  slow.use_laser();
  slow.use_device({}, 5);
  EXPECT_SAYS(test::complaint_of([&] { slow.build(); }),
              "its rate is 5 Hz, less than the 10 scans that the device takes in a second");
}

TEST(Scip2, WarnsOfStepsWithoutRay) {
  Room s;
  s.use_laser({{"min_angle", -1.0}, {"max_angle", 1.0}, {"rays", std::int64_t(100)}});
  s.use_device();
  s.build();
  EXPECT_SAYS(s.log, "of 682 steps of the device have no ray of `rover_0/laser` and read 0; what covers them is ");
  EXPECT_SAYS(s.log, "rays of `rover_0/laser` are farther apart than steps of the device");
}

}  // namespace
}  // namespace muro::scip2
