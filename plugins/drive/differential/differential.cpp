// SPDX-License-Identifier: MIT
// Turns the commanded velocity of a base into the speeds of its left and right wheels, which do not slip.
#include "muro/plugin.hpp"
#include "plugins/common/wheels/side_wheel_drive.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {left_wheels, right_wheels, wheel_radius, track, max_wheel_speed};
constexpr Description description{
    .id = "drive.differential",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with a driven wheel on each side",
    .parameters = parameters,
    .reads = side_wheel_drive_reads,
    .writes = side_wheel_drive_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SideWheelDrive>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_differential", .version = description.version, .licence = "MIT",
            .summary = "Drive of vehicles with a driven wheel on each side", .algorithms = algorithms)
