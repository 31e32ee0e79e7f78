// SPDX-License-Identifier: MIT
// drive.differential for vehicles whose wheels skid when they turn. Such wheels act as if they were farther apart
// (Mandow et al., Experimental kinematics for wheeled skid-steer mobile robots, IROS 2007).
#include "muro/plugin.hpp"
#include "plugins/common/wheels/side_wheel_drive.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {
    left_wheels,
    right_wheels,
    wheel_radius,
    track,
    max_wheel_speed,
    real("track_scale", "1", 1, "effective track by track: above 1 where turning wheels slip sideways")
        .between(0.1, 10),
};
constexpr Description description{
    .id = "drive.skid_steer",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with several driven wheels on each side",
    .parameters = parameters,
    .reads = side_wheel_drive_reads,
    .writes = side_wheel_drive_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class SkidSteer final : public SideWheelDrive {
  double track_scale(const Parameters& p) const override { return p.real("track_scale"); }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SkidSteer>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_skid_steer", .version = description.version, .licence = "MIT",
            .summary = "Drive of vehicles with several driven wheels on each side", .algorithms = algorithms)
