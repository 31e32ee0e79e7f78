// SPDX-License-Identifier: MIT
// Vehicles with mecanum or omni wheels: three or more wheels with rollers, whose speeds give any velocity in the plane.
#include "plugins/wheeled/omni.hpp"
#include "plugins/wheeled/wheel_motion.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    texts("wheels", "joints of the wheels; default: as the model has them"),
    reals("roller_angle", "rad", {},
          "from a wheel's rolling direction to the axis of the roller on the ground: one for all, or one a wheel; "
          "default: mecanum (pi/4) or omni wheels (0), as they stand"),
    real("wheel_radius", "m", 0, "of every wheel; 0: of the wheels' shapes").between(0, 1e3),
    real("max_wheel_acceleration", "rad/s^2", unlimited, "of every wheel; 1e9: none, the speed jumps")
        .between(1e-6, unlimited),
    on_contact,
};
constexpr Use reads[] = {
    {"joint.velocity.target", "of every joint that follows no other"},
    {"pose.initial", "of the base"},
    {"twist.initial", "of the base; what wheels can follow of it is their speed at the start"},
    {"joint.position.initial", "of every joint, optional"},
    {"collision.shapes", "of the wheels; else visual.shapes"},
    on_contact_reads,
};
constexpr Use writes[] = {{"pose", "of the base"},
                          {"twist", "of the base"},
                          {"joint.position", "of every joint"},
                          {"joint.velocity", "of every joint"}};
constexpr Description description{
    .id = "motion.omni",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base along exact arcs in a plane as its mecanum or omni wheels turn; no forces, no slip",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_joint_limits | feature_joint_speed_limits |
                feature_mimic_joints,
};

class Omni final : public WheelMotion {
  std::vector<WheelShare> shares_of(const Connector& c, const RobotView& robot) const override {
    const Parameters& p = c.parameters();
    const std::vector<OmniWheel> wheels =
        find_omni_wheels(c, robot, {p.texts("wheels"), p.reals("roller_angle"), p.real("wheel_radius")});
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
