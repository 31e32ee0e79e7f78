// SPDX-License-Identifier: MIT
// An accelerometer: the specific force at the device, in its own axes.
#include "muro/plugin.hpp"
#include "plugins/sensor/common/internal_sensor/inertial.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr PropertyUse reads[] = {reads_pose,           reads_twist,          reads_acceleration,
                                 reads_joint_position, reads_joint_velocity, reads_joint_acceleration,
                                 reads_gravity};
constexpr PropertyUse writes[] = {{"linear_acceleration", "specific force in the axes of the device"}, mounting_writes};
constexpr Description description{
    .id = "sensor.accelerometer",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Specific force at the device, as an accelerometer feels it",
    .parameters = mounting_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

struct Accelerometer final : InertialSensor {
  Accelerometer() : InertialSensor({.linear_acceleration = true}) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Accelerometer>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_accelerometer", .version = description.version, .licence = "MIT",
            .summary = "An accelerometer", .algorithms = algorithms)
