// SPDX-License-Identifier: MIT
// Vehicles with mecanum or omni wheels: three or more wheels with rollers, whose speeds give any velocity in the plane.
#include "plugins/common/wheels/omni.hpp"
#include "plugins/common/wheels/wheel_motion.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    all_wheels, roller_angle, wheel_radius, max_wheel_acceleration, on_contact,
};
constexpr PropertyUse reads[] = {
    {"joint.velocity.target", "of every joint that follows no other"},
    starts_at,
    starts_with,
    joints_start_at,
    sizes,
    on_contact_reads,
};
constexpr Description description{
    .id = "motion.omni",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base along exact arcs in a plane as its mecanum or omni wheels turn; no forces, no slip",
    .parameters = parameters,
    .reads = reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_joint_limits | feature_joint_speed_limits |
                feature_mimic_joints,
};

class Omni final : public WheelMotion {
  std::vector<WheelShare> shares_of(const Connector& c, const RobotView& robot) const override {
    const Parameters& p = c.parameters();
    const std::vector<OmniWheel> wheels =
        find_omni_wheels(c, robot, {p.texts(all_wheels.name), p.reals(roller_angle.name), p.real(wheel_radius.name)});
    const std::vector<PlanarTwist> shares = wheeled::shares_of(robot, wheels);
    std::vector<WheelShare> all;
    for (std::size_t i = 0; i < wheels.size(); ++i)
      all.push_back({wheels[i].frame, wheels[i].limits.velocity, shares[i], asks_of(wheels[i])});
    return all;
  }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Omni>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_omni", .version = "1.0.0", .licence = "MIT",
            .summary = "Kinematic motion of vehicles with mecanum or omni wheels", .algorithms = algorithms)
