// SPDX-License-Identifier: MIT
// An inertial measurement unit with an estimate of its orientation, which here is the true orientation.
#include "muro/plugin.hpp"
#include "plugins/sensor/common/internal_sensor/inertial.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr PropertyUse reads[] = {reads_pose,           reads_twist,          reads_acceleration,
                                 reads_joint_position, reads_joint_velocity, reads_joint_acceleration,
                                 reads_gravity};
constexpr PropertyUse writes[] = {{"angular_velocity", "in the axes of the device"},
                                  {"linear_acceleration", "specific force in the axes of the device"},
                                  {"orientation", "of the device in the world"},
                                  mounting_writes};
constexpr Description description{
    .id = "sensor.imu",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Angular velocity, specific force and orientation of the device: an inertial measurement unit",
    .parameters = mounting_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

struct Imu final : InertialSensor {
  Imu() : InertialSensor({.angular_velocity = true, .linear_acceleration = true, .orientation = true}) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Imu>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_imu", .version = description.version, .licence = "MIT",
            .summary = "An inertial measurement unit", .algorithms = algorithms)
