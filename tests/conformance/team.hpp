// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <set>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::test {

/// Returns the ids of all algorithms of one kind in the build.
inline std::vector<std::string> algorithms_of(const std::string& kind) {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : plugins().catalog())
    if (o.kind == kind) ids.push_back(o.id);
  return ids;
}

/// Whether a motion needs the names of certain parts of a robot, and so does not move other robots.
inline bool names_parts(const std::string& motion) {
  const Rows<Parameter> known = plugins().algorithm(motion).description->parameters;
  return std::any_of(known.begin(), known.end(), [](const Parameter& p) { return p.is_required; });
}

/// Returns "motion_ode" for motion.ode, since names of tests have no dots.
inline std::string name_of(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// A model that a motion can move, its drive, the link that carries a laser, and parameters of the motion.
struct Vehicle {
  std::string model, drive, laser = "laser_link";
  std::map<std::string, ParameterInput> parameters{};
};
inline Vehicle vehicle_for(const std::string& motion) {
  if (motion == "motion.ackermann") return {"car", "drive.ackermann"};
  if (motion == "motion.omni") return {"mecanum", "drive.omni"};
  if (motion == "motion.biped")
    return {"biped",
            "",
            "camera_link",
            {{"feet", std::vector<std::string>{"left_foot", "right_foot"}}, {"joints", std::string("velocity")}}};
  return {"rover", "drive.skid_steer"};
}

/// Robots of one motion on a plane between a few boxes, with lasers. Vehicles get commands for the velocity of their
/// bases, other robots for those of their joints.
struct Team : Scene {
  std::vector<const RobotView*> rovers;

  explicit Team(const std::string& motion, int count = 5, std::uint64_t seed = 1) : Scene(seed) {
    add_ground();
    const Shape block = Shape::box({1, 1, 1});
    for (int i = 0; i < 4; ++i)
      world().add_scenery("block_" + std::to_string(i), {{3.0 * i, 1.5, 0.5}, Quat::Identity()},
                          std::span<const Shape>(&block, 1));
    const Vehicle vehicle = vehicle_for(motion);
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/" + vehicle.model + ".urdf");
    for (int i = 0; i < count; ++i)
      rovers.push_back(
          &add("rover_" + std::to_string(i), model, {{1.5 * i, 0, model.standing_height()}, from_rpy(0, 0, 0.3 * i)}));
    use(motion, 1000, all_robots(), vehicle.parameters);
    if (!vehicle.drive.empty()) use(vehicle.drive, 0, all_robots());
    use_contacts();
    std::vector<Item> sensors;
    for (const RobotView* r : rovers)
      sensors.push_back(
          {r, add_sensor_object(*r, "laser", world().object(std::string(r->name) + "/" + vehicle.laser))});
    use("laser.raycast", 10, sensors, {{"rays", std::int64_t(181)}, {"max_range", 5.6}});
    use("sensor.error", 0, sensors, {{"sigma", 0.01}, {"correlation", 0.5}});
    build();
    command();
  }
  void command() {
    for (const RobotView* r : rovers) {
      const double turn = 0.2 * double(index_of(r->id)) - 0.4;
      if (world().has(r->base(), "command.twist")) {
        world().value(r->base(), keys::command_twist) = {{0.5, 0, 0}, {0, 0, turn}};
        continue;
      }
      const auto turn_joint = [&](const char* joint, double rate) {
        world().value(std::string(r->name) + joint, keys::joint_velocity_target) = rate;
      };
      turn_joint("/left_hip_pitch", -0.05);  // lifts the foot and keeps it level
      turn_joint("/left_knee", 0.1);
      turn_joint("/left_ankle_pitch", -0.05);
      turn_joint("/right_hip_yaw", 0.1 * turn);
    }
  }
};

}  // namespace muro::test
