// SPDX-License-Identifier: MIT
// recorder.csv in real simulations.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::ScratchFolder;
using test::text_of;

struct Recording : test::Scene {
  explicit Recording(const std::string& file, std::vector<std::string> properties, double rate = 16) {
    use("motion.point", 64, all_robots());
    use("recorder.csv", rate, {}, {{"file", file}, {"properties", std::move(properties)}});
  }
  void begin() {
    build();
    go();
  }
  void go() { world().value(ball.base(), keys::command_twist).linear = {2, 0, 0}; }

  const RobotView& ball = add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
};

std::string header_of(const std::string& path) {
  const std::string text = text_of(path);
  return text.substr(0, text.find("\r\n"));
}

std::string refusal(std::vector<std::string> properties) {
  const ScratchFolder folder;
  const std::string path = folder.path("log.csv");
  try {
    Recording(path, std::move(properties)).begin();
  } catch (const SetupError& e) {
    EXPECT_FALSE(std::filesystem::exists(path + ".part")) << "nothing is written before the set-up is right";
    return e.what();
  }
  return "it was accepted";
}

TEST(RecorderCsv, WritesMeansOverTheRunsSinceTheLastRow) {
  const ScratchFolder folder;
  test::Scene s;
  const RobotView& ball =
      s.add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  s.use("motion.point", 64, s.all_robots());
  s.use("recorder.csv", 64, {},
        {{"file", folder.path("log.csv")},
         {"properties", std::vector<std::string>{"ball/body:command.twist"}},
         {"mean", std::vector<std::string>{"ball/body:pose"}},
         {"every", 4.0}});
  s.build();
  s.world().value(ball.base(), keys::command_twist).linear = {64, 0, 0};  // 1 m a step
  s.run_for(9.0 / 64);
  s.finish();
  const std::string text = text_of(folder.path("log.csv"));
  EXPECT_NE(text.find("command.twist.wz,ball/body:pose.x.mean,"), std::string::npos) << text;
  EXPECT_NE(text.find("\r\n0,64,0,0,0,0,0,0,0,0,0,0,0,1\r\n"
                      "0.0625,64,0,0,0,0,0,2.5,0,0,0,0,0,1\r\n"  // 1, 2, 3, 4
                      "0.125,64,0,0,0,0,0,6.5,0,0,0,0,0,1\r\n"),
            std::string::npos)
      << text;
}

TEST(RecorderCsv, WritesARowForEachRunWithTheStateOfThatInstant) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {"ball/body:pose", "world:gravity"});
  s.begin();
  s.run_for(0.1875);
  s.finish();
  EXPECT_EQ(text_of(folder.path("log.csv")),
            "time,ball/body:pose.x,ball/body:pose.y,ball/body:pose.z,ball/body:pose.qx,ball/body:pose.qy,ball/"
            "body:pose.qz,ball/"
            "body:pose.qw,world:gravity.x,world:gravity.y,world:gravity.z\r\n"
            "0,0,0,0,0,0,0,1,0,0,-9.81\r\n"
            "0.0625,0.125,0,0,0,0,0,1,0,0,-9.81\r\n"
            "0.125,0.25,0,0,0,0,0,1,0,0,-9.81\r\n");
}

TEST(RecorderCsv, BeginsAnewAfterAReset) {
  const ScratchFolder folder;
  const std::string path = folder.path("log.csv");
  Recording s(path, {});
  s.begin();
  s.run_for(1);
  s.finish();
  const std::string first = text_of(path);
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 17);
  s.reset();
  EXPECT_EQ(text_of(path), first) << "until the next finish";
  s.go();
  s.run_for(1);
  s.finish();
  EXPECT_EQ(text_of(path), first);
}

TEST(RecorderCsv, ReplacesTheRowsSinceARestoredSnapshot) {
  const ScratchFolder folder;
  const std::string path = folder.path("log.csv");
  Recording s(path, {});
  s.begin();
  s.run_for(0.5);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  s.finish();
  const std::string straight = text_of(path);
  s.restore(middle);
  s.run_for(0.5);
  s.finish();
  EXPECT_EQ(text_of(path), straight);
}

TEST(RecorderCsv, RecordsThePosesOfAllBasesByDefault) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {});
  s.add("box", test::single_body(Shape::box({1, 1, 1}), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  s.world().set(s.world().object("box/body"), keys::pose, Pose{});  // it is parked
  s.begin();
  s.run_for(0.1);
  s.finish();
  const std::string header = header_of(folder.path("log.csv"));
  EXPECT_NE(header.find("ball/body:pose.x"), std::string::npos) << header;
  EXPECT_NE(header.find("box/body:pose.qw"), std::string::npos) << header;
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 14);
}

TEST(RecorderCsv, WildcardsTakeWhatChangesOnceEach) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {"ball/*:*", "*:pose", "ball/body:twi??"});
  s.add_ground();  // its pose is a constant
  s.begin();
  s.run_for(0.1);
  s.finish();
  EXPECT_EQ(
      header_of(folder.path("log.csv")),
      "time,ball/body:pose.x,ball/body:pose.y,ball/body:pose.z,ball/body:pose.qx,ball/body:pose.qy,ball/body:pose.qz,"
      "ball/body:pose.qw,ball/body:twist.vx,ball/body:twist.vy,ball/body:twist.vz,ball/body:twist.wx,ball/"
      "body:twist.wy,"
      "ball/body:twist.wz,ball/body:command.twist.vx,ball/body:command.twist.vy,ball/body:command.twist.vz,"
      "ball/body:command.twist.wx,ball/body:command.twist.wy,ball/body:command.twist.wz");
}

TEST(RecorderCsv, NumbersTheElementsOfArrays) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {"ball/body:ranges", "ball/body:offsets", "ball/body:laser.columns"});
  const std::vector<double> ranges{0.5, 1.5};
  const std::vector<Vec3> offsets{{1, 2, 3}, {4, 5, 6}};
  s.world().set_array(s.ball.base(), keys::ranges, std::span<const double>(ranges));
  s.world().set_array(s.ball.base(), Key<Vec3>{"offsets", "m", "two points"}, std::span<const Vec3>(offsets));
  s.world().set(s.ball.base(), keys::laser_columns, 2u);
  s.begin();
  s.run_for(0.01);
  s.finish();
  EXPECT_EQ(text_of(folder.path("log.csv")),
            "time,ball/body:ranges[0],ball/body:ranges[1],ball/body:offsets[0].x,ball/body:offsets[0].y,ball/"
            "body:offsets[0].z,"
            "ball/body:offsets[1].x,ball/body:offsets[1].y,ball/body:offsets[1].z,ball/body:laser.columns\r\n"
            "0,0.5,1.5,1,2,3,4,5,6,2\r\n");
}

TEST(RecorderCsv, RecordsTheForcesOfTheStepThatLedToTheState) {
  const ScratchFolder folder;
  test::Scene s;
  const double mass = 2, g = 9.81, dt = 1e-3;
  const Inertia inertia{.mass = mass, .ixx = 0.02, .iyy = 0.02, .izz = 0.02};
  const Pose start{{0, 0, 0.102}, Quat::Identity()};  // 2 mm above the ground
  const RobotView& crate = s.add("crate", test::single_body(Shape::box({0.4, 0.4, 0.2}), inertia), start);
  s.add_ground();
  s.use("motion.simplified", 1 / dt, {{&crate, crate.base()}});
  s.use_contacts();
  const std::vector<std::string> properties{"crate/body:twist", "crate/body:wrench.external"};
  s.use("recorder.csv", 1 / dt, {}, {{"file", folder.path("log.csv")}, {"properties", properties}});
  s.build();
  s.run_for(0.2);
  s.finish();
  std::ifstream file(folder.path("log.csv"));
  std::string row;
  std::getline(file, row);
  double vz_before = 0, max_fz = 0;
  for (int k = 0; std::getline(file, row); ++k) {
    double t = 0, vx = 0, vy = 0, vz = 0, wx = 0, wy = 0, wz = 0, fx = 0, fy = 0, fz = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t, &vx, &vy, &vz, &wx, &wy, &wz, &fx,
                          &fy, &fz),
              10);
    if (k > 0) {
      EXPECT_NEAR(mass * (vz - vz_before), (fz - mass * g) * dt, 1e-7) << "momentum, at t = " << t;
    }
    vz_before = vz;
    max_fz = std::max(max_fz, fz);
  }
  EXPECT_GT(max_fz, mass * g) << "there was an impact on the ground";
}

TEST(RecorderCsv, NamesTheNearestPropertyWhenNothingMatches) {
  EXPECT_EQ(
      refusal({"bal/body:pose"}),
      "recorder.csv #1 (recorder.csv) cannot be connected: no property matches `bal/body:pose` (did you mean "
      "`ball/body:pose`?); write \"object:property\", such as \"rover_0/base_link:pose\"; `muro describe` lists all");
}

TEST(RecorderCsv, RefusesWhatHasNoColumns) {
  EXPECT_EQ(
      refusal({"ball/body:collision.shapes"}),
      "recorder.csv #1 (recorder.csv) cannot be connected: `ball/body:collision.shapes` cannot be recorded: it has no "
      "columns: it is of type muro.Shape, which is not made of numbers");
  EXPECT_EQ(refusal({"ball/body:inert*"}),
            "recorder.csv #1 (recorder.csv) cannot be connected: `ball/body:inert*` matches only what does not change "
            "or has no "
            "columns, such as `ball/body:inertial`; name a constant without wildcards to record it");
}

TEST(RecorderCsv, EndsTheRunWhenTheDiskIsFull) {
  Recording s("/dev/full", {}, 64);
  s.begin();
  try {
    s.run_for(1000);
    FAIL();
  } catch (const StepError& e) {
    EXPECT_NE(std::string(e.what()).find("file /dev/full cannot be written: No space left on device"),
              std::string::npos)
        << e.what();
  }
}

TEST(RecorderCsv, SaysBeforeTheRunThatItCannotWrite) {
  Recording s("/nowhere/log.csv", {});
  EXPECT_THROW(s.build(), SetupError);
}

}  // namespace
}  // namespace muro
