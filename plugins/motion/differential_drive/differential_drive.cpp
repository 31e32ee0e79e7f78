// SPDX-License-Identifier: MIT
// Differential drive (MuRoSimF, Section 3.1): the wheels of both sides roll on a plane and never slip along it, so the
// velocity of the base follows from those of the wheels. Kinematics after Siegwart, Nourbakhsh and Scaramuzza,
// Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.
#include "plugins/common/wheels/side_wheels.hpp"

#include "plugins/common/wheels/wheel_motion.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    left_wheels, right_wheels, wheel_radius, track, max_wheel_acceleration, on_contact,
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
    .id = "motion.differential_drive",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary =
        "Moves the base along exact arcs in a plane as its left and right wheels turn; no forces, no slip along the "
        "way",
    .parameters = parameters,
    .reads = reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_joint_limits | feature_joint_speed_limits |
                feature_mimic_joints,
};

/// Velocity of the base when one side moves over the ground at 1 m/s and the other stands still. The base turns
/// about a point on the line through the wheels' centres, wherever on the robot its own origin is.
PlanarTwist share_of(const Wheels& wheels, bool left) {
  const double turn = (left ? -1 : 1) / wheels.track;
  return {0.5 + turn * wheels.middle.y(), -turn * wheels.middle.x(), turn};
}

class DifferentialDrive final : public WheelMotion {
  std::vector<WheelShare> shares_of(const Connector& c, const RobotView& robot) const override {
    const Parameters& p = c.parameters();
    const Wheels wheels = find_wheels(
        c, robot,
        {p.texts(left_wheels.name), p.texts(right_wheels.name), p.real(wheel_radius.name), p.real(track.name)});
    std::vector<WheelShare> shares;
    for (const bool left : {true, false}) {
      const std::vector<Wheel>& side = left ? wheels.left : wheels.right;
      const double y = wheels.middle.y() + (left ? 0.5 : -0.5) * wheels.track;
      for (const Wheel& w : side) {
        const double per_metre = w.direction / w.radius;
        shares.push_back({w.frame, w.limits.velocity,
                          share_of(wheels, left) * (w.direction * w.radius / double(side.size())),
                          PlanarTwist{1, 0, -y} * per_metre});
      }
    }
    return shares;
  }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<DifferentialDrive>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_differential_drive", .version = "1.0.0", .licence = "MIT",
            .summary = "Kinematic motion of wheeled vehicles with differential drive", .algorithms = algorithms)
