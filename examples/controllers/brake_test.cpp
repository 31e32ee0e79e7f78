// SPDX-License-Identifier: MIT
// The controller in four languages: it stops before the wall, in the same way in all of them.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns the place of the rover every half second, m.
std::vector<double> drive(const std::string& library, const std::string& isolate) {
  const std::string control = "robots.rover.control.";
  const BuiltScenario built = build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/controllers/brake.yaml",
                                                  {control + "library=" + library, control + "isolate=" + isolate}),
                                    test::plugins());
  Simulation& s = *built.simulation;
  s.set_log([](LogLevel, std::string_view) {});
  std::vector<double> way;
  for (int i = 0; i < 20; ++i) {
    s.run_for(0.5);
    way.push_back(s.world().value(s.world().find_robot("rover")->base(), keys::pose).position.x());
  }
  return way;
}

class Brake : public ::testing::TestWithParam<const char*> {};

TEST_P(Brake, DrivesToTheBitLikeTheOneInC) {
  const std::vector<double> way = drive("brake_c", "none");
  EXPECT_GT(way[3], 0.4) << "it drives";
  EXPECT_NEAR(way.back(), 2.9 - 0.6 - 0.1, 0.02) << "it stands before the wall; its laser is 0.1 m in front of it";
  EXPECT_EQ(drive(GetParam(), "none"), way);
  EXPECT_EQ(drive(GetParam(), "process"), way);
}
INSTANTIATE_TEST_SUITE_P(In, Brake, ::testing::Values(BRAKES));

TEST(Brakes, RefuseALaserThatIsTooPoor) {
  for (const char* library : {"brake_c", "brake_cpp"}) {
    const BuiltScenario built =
        build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/controllers/brake.yaml",
                            {"robots.rover.control.library=" + std::string(library), "robots.rover.laser.rays=2"}),
              test::plugins());
    try {
      built.simulation->run_for(1);
      FAIL() << library;
    } catch (const StepError& e) {
      EXPECT_NE(std::string(e.what()).find("the laser has 2 rays; it needs 3 or more"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace muro::host
