// SPDX-License-Identifier: MIT
#pragma once

#include <set>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::test {

/// The ids of all algorithms of one kind that the build offers.
inline std::vector<std::string> algorithms_of(const std::string& kind) {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : plugins().catalog())
    if (o.kind == kind) ids.push_back(o.id);
  return ids;
}

/// "motion_ode" for motion.ode: names of tests have no dots.
inline std::string name_of(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// What a motion is tried with: a model that it can move, and its drive.
struct Vehicle {
  std::string model, drive;
};
inline Vehicle vehicle_for(const std::string& motion) {
  if (motion == "motion.ackermann") return {"car", "drive.ackermann"};
  if (motion == "motion.omni") return {"mecanum", "drive.omni"};
  return {"rover", "drive.skid_steer"};
}

/// Rovers that all move by one algorithm on a plane between a few boxes, with lasers; commanded from outside.
struct Team : Scene {
  std::vector<const RobotView*> rovers;

  explicit Team(const std::string& motion, int count = 5, std::uint64_t seed = 1) : Scene(seed) {
    add_ground();
    const Shape block = Shape::box({1, 1, 1});
    for (int i = 0; i < 4; ++i)
      world().add_scenery("block_" + std::to_string(i), {{3.0 * i, 1.5, 0.5}, Quat::Identity()},
                          std::span<const Shape>(&block, 1));
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/" + vehicle_for(motion).model + ".urdf");
    for (int i = 0; i < count; ++i)
      rovers.push_back(
          &add("rover_" + std::to_string(i), model, {{1.5 * i, 0, model.standing_height()}, from_rpy(0, 0, 0.3 * i)}));
    use(motion, 1000, all_robots());
    use(vehicle_for(motion).drive, 0, all_robots());
    use_contacts();
    std::vector<Item> sensors;
    for (const RobotView* r : rovers)
      sensors.push_back({r, add_sensor_object(*r, "laser", world().object(std::string(r->name) + "/laser_link"))});
    use("laser.raycast", 10, sensors, {{"rays", std::int64_t(181)}, {"max_range", 5.6}});
    use("sensor.error", 0, sensors, {{"sigma", 0.01}, {"correlation", 0.5}});
    build();
    command();
  }
  void command() {
    for (const RobotView* r : rovers)
      world().value(r->base(), keys::command_twist) = {{0.5, 0, 0}, {0, 0, 0.2 * double(r->number) - 0.4}};
  }
};

}  // namespace muro::test
