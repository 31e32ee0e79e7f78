// SPDX-License-Identifier: MIT
// A gyroscope: the angular velocity of the device, in its own axes.
#include "muro/plugin.hpp"
#include "plugins/sensor/common/internal_sensor/inertial.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr PropertyUse reads[] = {reads_pose, reads_twist, reads_joint_position, reads_joint_velocity};
constexpr PropertyUse writes[] = {{"angular_velocity", "in the axes of the device"}, mounting_writes};
constexpr Description description{
    .id = "sensor.gyro",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Angular velocity of the device, as a gyroscope feels it",
    .parameters = mounting_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

struct Gyro final : InertialSensor {
  Gyro() : InertialSensor({.angular_velocity = true}) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Gyro>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_gyro", .version = description.version, .licence = "MIT", .summary = "A gyroscope",
            .algorithms = algorithms)
