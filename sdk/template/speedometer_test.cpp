// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/simulation.hpp"
#include "tests/support/bodies.hpp"

namespace muro {
namespace {

constexpr Key<double> speed{"speedometer.speed", "m/s", "what the needle shows"};

TEST(Speedometer, ApproachesAConstantSpeedAsAFirstOrderLag) {
  Registry registry({MURO_TEST_PLUGIN_DIR, SPEEDOMETER_DIR});
  Simulation simulation(registry);
  const RobotView& rover = simulation.world().add_robot("rover", test::single_body(Shape::box({1, 1, 1}), {}), {});
  simulation.use("motion.point", 1000, {{&rover, rover.base()}});
  simulation.use("sensor.speedometer", 50, {{&rover, rover.base()}}, {{"time_constant", 0.5}});
  simulation.build();
  simulation.world().value(rover.base(), keys::command_twist).linear = Vec3(3, 4, 0);
  for (int second = 1; second <= 3; ++second) {
    // the instant at the end belongs to the next stretch: the last run was one period earlier
    simulation.run_for(1);
    EXPECT_NEAR(simulation.world().value(rover.base(), speed), 5 * (1 - std::exp(-(second - 0.02) / 0.5)), 1e-9);
  }
}

}  // namespace
}  // namespace muro
