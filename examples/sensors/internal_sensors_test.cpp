// SPDX-License-Identifier: MIT
// The standing humanoid with all internal sensors.
#include <gtest/gtest.h>

#include <set>

#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

BuiltScenario standing() {
  BuiltScenario built =
      build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/sensors/internal.yaml", {}), test::plugins());
  built.simulation->run_for(2);
  return built;
}

TEST(InternalSensors, AreAllInTheExample) {
  const BuiltScenario built = standing();
  std::set<std::string> used;
  for (const auto& instance : built.simulation->instances()) used.emplace(instance->description().id);
  for (const CatalogEntry& entry : test::plugins().catalog())
    if (entry.id.starts_with("sensor.")) {
      EXPECT_TRUE(used.contains(entry.id)) << entry.id;
    }
}

TEST(InternalSensors, ReadWhatARobotThatStandsFeels) {
  const BuiltScenario built = standing();
  const World& world = built.simulation->world();
  const auto of = [&](const char* object, const auto& key) { return world.value(world.object(object), key); };
  const double left = of("humanoid/left_sole", keys::foot_force), right = of("humanoid/right_sole", keys::foot_force);
  double mass = 0;
  for (const Link& link : world.find_robot("humanoid")->links)
    if (const auto* inertia = world.store().find(link.object, keys::inertial.name))
      mass += static_cast<const Inertia*>(inertia->place)->mass;
  EXPECT_NEAR(left + right, mass * 9.81, 0.01 * mass * 9.81);
  EXPECT_EQ(of("humanoid/left_sole", keys::foot_contact), 1u);
  EXPECT_NEAR(of("humanoid/ankle", keys::sensed_wrench).force.z(), left - 0.1 * 9.81, 0.01)
      << "the force on the sole without the weight of the foot, 0.1 kg";
  EXPECT_NEAR(of("humanoid/accelerometer", keys::linear_acceleration).norm(), 9.81, 1e-3);
  EXPECT_LT(of("humanoid/gyro", keys::angular_velocity).norm(), 1e-3);
  EXPECT_EQ(of("humanoid/chest", keys::bumper_pressed), 0u);
  EXPECT_NEAR(of("humanoid/compass", keys::magnetic_field).norm(), 4.8488e-5, 1e-8) << "of the field";
  EXPECT_NEAR(of("humanoid/gps", keys::latitude), 49.8776, 1e-6);
  const double north = (of("humanoid/gps", Key<double>{"latitude.measured", "deg", ""}) - 49.8776) * 111.2e3;
  EXPECT_LT(std::abs(north), 4 * 2.2) << "m";
  EXPECT_NE(north, 0);
}

}  // namespace
}  // namespace muro::host
