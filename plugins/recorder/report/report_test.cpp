// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/external/reported_numbers.hpp"
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
  /// Returns the contents of the report of a run of one second, by name.
  const ReportedNumbers::Section& written() {
    run_for(1);
    finish();
    const auto& sections = reported_numbers().sections();
    EXPECT_EQ(sections.size(), 1u);
    EXPECT_EQ(sections.at(0).first, "properties");
    return sections.at(0).second;
  }

  const RobotView& ball = add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
};

TEST(RecorderReport, TellsWhatPropertiesAreAtTheEnd) {
  Recorded s({"ball/body:pose", "ball/body:command.twist"});
  const auto& written = s.written();
  ASSERT_EQ(written.size(), 2u);
  EXPECT_EQ(written[0].first, "ball/body:pose");
  ASSERT_EQ(written[0].second.size(), 7u);
  EXPECT_EQ(written[0].second[0].first, ".x");
  EXPECT_NEAR(written[0].second[0].second, 2, 1e-12) << "m: 1 s at 2 m/s";
  EXPECT_EQ(written[1].second[0], (std::pair<std::string, double>(".vx", 2)));
}

TEST(RecorderReport, RefusesWhatThereIsNot) {
  try {
    const Recorded none({"ball/body:score"});
    FAIL() << "there is no score";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("no property matches `ball/body:score`"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace muro
