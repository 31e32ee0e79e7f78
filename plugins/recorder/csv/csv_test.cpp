// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>

#include "csv_file.hpp"
#include "glob.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using test::ScratchFolder;
using test::text_of;

TEST(Glob, StarsAndQuestionMarksStandForCharacters) {
  EXPECT_TRUE(fits("rover_*/base_link:pose", "rover_12/base_link:pose"));
  EXPECT_TRUE(fits("*:pose", "a/b:pose"));
  EXPECT_TRUE(fits("a?c", "abc"));
  EXPECT_TRUE(fits("*a*b*", "xxaxxbxx"));
  EXPECT_FALSE(fits("*a*b", "xxaxxbxx"));
  EXPECT_FALSE(fits("a?c", "ac"));
  EXPECT_FALSE(fits("", "a"));
  EXPECT_TRUE(fits("*", ""));
}

TEST(CsvFile, QuotesAsRfc4180SaysAndNumbersReadBackToTheBit) {
  const ScratchFolder folder;
  CsvFile file(folder.path("a.csv"));
  file.text("plain");
  file.text("a,\"b\"");
  const double third = 1.0 / 3;
  file.number(third);
  const std::int64_t least = INT64_MIN;
  file.number(Scalar::i64, &least);
  file.end_row();
  file.flush();
  EXPECT_EQ(text_of(folder.path("a.csv")), "plain,\"a,\"\"b\"\"\",0.3333333333333333,-9223372036854775808\r\n");
  EXPECT_EQ(std::stod("0.3333333333333333"), third);
}

TEST(CsvFile, SaysWhyItCannotBeWritten) {
  EXPECT_THROW(CsvFile("/nowhere/at/all.csv"), Error);
  CsvFile full("/dev/full");
  full.text("x");
  full.end_row();
  try {
    full.flush();
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "file /dev/full cannot be written: No space left on device");
  }
}

struct Recording : test::Scene {
  const RobotView& ball = add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  Recording(const std::string& file, std::vector<std::string> properties, double rate = 16) {
    use("motion.point", 64, all_robots());
    use("recorder.csv", rate, {}, {{"file", file}, {"properties", std::move(properties)}});
    build();
    world().value(ball.base(), keys::command_twist).linear = {2, 0, 0};
  }
};

TEST(RecorderCsv, WritesARowForEachRunWithTheStateOfThatInstant) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {"ball/body:pose", "world:gravity"});
  s.run_for(0.1875);
  s.finish();
  EXPECT_EQ(text_of(folder.path("log.csv")),
            "time,ball/body:pose.x,ball/body:pose.y,ball/body:pose.z,ball/body:pose.qx,ball/body:pose.qy,ball/body:pose.qz,ball/"
            "body:pose.qw,world:gravity.x,world:gravity.y,world:gravity.z\r\n"
            "0,0,0,0,0,0,0,1,0,0,-9.81\r\n"
            "0.0625,0.125,0,0,0,0,0,1,0,0,-9.81\r\n"
            "0.125,0.25,0,0,0,0,0,1,0,0,-9.81\r\n");
}

TEST(RecorderCsv, BeginsAnewAfterAReset) {
  const ScratchFolder folder;
  Recording s(folder.path("log.csv"), {});
  s.run_for(1);
  s.finish();
  const std::string first = text_of(folder.path("log.csv"));
  s.reset();
  s.world().value(s.ball.base(), keys::command_twist).linear = {2, 0, 0};
  s.run_for(1);
  s.finish();
  EXPECT_EQ(text_of(folder.path("log.csv")), first);
}

TEST(RecorderCsv, NamesTheNearestPropertyWhenNothingFits) {
  const ScratchFolder folder;
  try {
    Recording s(folder.path("log.csv"), {"bal/body:pose"});
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_STREQ(e.what(),
                 "recorder.csv #1 (recorder.csv) cannot be connected: no property fits `bal/body:pose` (did you mean "
                 "`ball/body:pose`?); write \"object:property\", such as \"rover_0/base_link:pose\"; `muro describe` lists all");
  }
}

TEST(RecorderCsv, RefusesWhatHasNoColumns) {
  const ScratchFolder folder;
  EXPECT_THROW(Recording(folder.path("log.csv"), {"ball/body:collision.shapes"}), SetupError);
  EXPECT_FALSE(std::filesystem::exists(folder.path("log.csv"))) << "nothing is written before the set-up is right";
}

}  // namespace
}  // namespace muro
