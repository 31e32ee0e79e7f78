// SPDX-License-Identifier: MIT
// Plugins that were built outside muro's tree are found, loaded and correct. The tests package.*, which run before,
// give their folders.
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"

namespace muro {
namespace {

constexpr Key<double> energy{"battery.energy", "J", "what is left in the battery"};
constexpr Key<double> speed{"speedometer.speed", "m/s", "what the needle shows"};

class OutOfTree : public testing::TestWithParam<const char*> {};

TEST_P(OutOfTree, BatteryIsDrainedByIdlePowerAndRollingResistance) {
  Registry registry({MURO_TEST_PLUGIN_DIR, std::string(SCRATCH "/example_against_the_") + GetParam()});
  Simulation simulation(registry);
  Inertia inertia;
  inertia.mass = 20;
  const RobotView& rover = simulation.world().add_robot("rover", test::single_body(Shape::box({1, 1, 1}), inertia), {});
  simulation.use("motion.point", 100, {{&rover, rover.base()}});
  simulation.use("sensor.battery", 10, {{&rover, rover.base()}},
                 {{"capacity", 1000.0}, {"idle_power", 5.0}, {"rolling_resistance", 0.05}, {"efficiency", 0.5}});
  simulation.build();
  simulation.world().value(rover.base(), keys::command_twist).linear = Vec3(2, 0, 0);
  // to 10 s, with the run that is due then: 5 W + 0.05 * 20 kg * 9.80665 m/s^2 * 2 m/s / 0.5
  simulation.run_until(10'000'000'001);
  EXPECT_NEAR(simulation.world().value(rover.base(), energy), 1000 - 10 * (5 + 0.05 * 20 * 9.80665 * 2 / 0.5), 1e-9);
  simulation.run_for(100);
  EXPECT_EQ(simulation.world().value(rover.base(), energy), 0);
}
INSTANTIATE_TEST_SUITE_P(Example, OutOfTree, testing::Values("build_tree", "installation"),
                         [](const auto& test) { return std::string(test.param); });

class Template : public testing::TestWithParam<const char*> {};

TEST_P(Template, ShowsTheSpeedAfterALongTime) {
  Registry registry({MURO_TEST_PLUGIN_DIR, std::string(SCRATCH "/template_against_the_") + GetParam()});
  Simulation simulation(registry);
  const RobotView& rover = simulation.world().add_robot("rover", test::single_body(Shape::box({1, 1, 1}), {}), {});
  simulation.use("motion.point", 100, {{&rover, rover.base()}});
  simulation.use("sensor.speedometer", 10, {{&rover, rover.base()}});
  simulation.build();
  simulation.world().value(rover.base(), keys::command_twist).linear = Vec3(3, 4, 0);
  simulation.run_for(10);
  EXPECT_NEAR(simulation.world().value(rover.base(), speed), 5, 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Out, Template, testing::Values("installation", "source_tree"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace muro
