// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/report.hpp"
#include "tests/support/bodies.hpp"

namespace muro {
namespace {

struct Recorded : test::Scene {
  explicit Recorded(std::vector<std::string> properties) {
    use("motion.point", 64, all_robots());
    use("recorder.report", 1, {}, {{"properties", std::move(properties)}});
    build();
    world().value(ball.base(), keys::command_twist).linear = {2, 0, 0};
  }
  nlohmann::ordered_json written() {
    run_for(1);
    finish();
    const host::Odometer odometer(*this);
    return host::report({}, *this, odometer)["properties"];
  }

  const RobotView& ball = add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
};

TEST(RecorderReport, TellsWhatPropertiesAreAtTheEnd) {
  const auto written = Recorded({"ball/body:pose", "ball/body:command.twist"}).written();
  ASSERT_EQ(written.size(), 2u);
  EXPECT_EQ(written[0]["name"], "ball/body:pose");
  EXPECT_NEAR(written[0][".x"].get<double>(), 2, 1e-12) << "m: 1 s at 2 m/s";
  EXPECT_EQ(written[0][".qw"].dump(), "1") << "whole numbers have no point";
  EXPECT_EQ(written[1][".vx"].dump(), "2");
}

TEST(RecorderReport, RefusesWhatThereIsNot) {
  try {
    Recorded({"ball/body:score"});
    FAIL() << "there is no score";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("no property matches `ball/body:score`"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace muro
