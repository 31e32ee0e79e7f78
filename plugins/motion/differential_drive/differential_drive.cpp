// SPDX-License-Identifier: MIT
// Differential drive (MuRoSimF, Section 3.1): the wheels of both sides roll on a plane and never slip along it, so the
// velocity of the base follows from those of the wheels. Kinematics after Siegwart, Nourbakhsh and Scaramuzza,
// Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.
#include "plugins/common/wheels/side_wheels.hpp"
#include "plugins/motion/common/wheel_motion/wheel_motion.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {
    left_wheels, right_wheels, wheel_radius, track, max_wheel_acceleration, on_contact,
};
constexpr Description description{
    .id = "motion.differential_drive",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary =
        "Moves the base along exact arcs in a plane as its left and right wheels turn; no forces, no slip along the "
        "way",
    .parameters = parameters,
    .reads = wheel_motion_reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = wheel_motion_features,
};

/// Returns the velocity of the base when one side moves over the ground at 1 m/s and the other stands still. The base
/// turns about a point on the line through the wheels' centres, whatever its own origin is.
PlanarTwist velocity_by_side(const SideWheels& wheels, bool is_left) {
  const double yaw_rate = (is_left ? -1 : 1) / wheels.track;
  return {0.5 + yaw_rate * wheels.middle.y(), -yaw_rate * wheels.middle.x(), yaw_rate};
}

class DifferentialDrive final : public WheelMotion {
  std::vector<WheelJacobian> jacobian_of(const Connector& c, const RobotView& robot) const override {
    const SideWheels found = find_side_wheels(c, robot);
    std::vector<WheelJacobian> jacobian;
    for (const bool is_left : {true, false}) {
      const std::vector<Wheel>& side = is_left ? found.left : found.right;
      const double y = found.middle.y() + (is_left ? 0.5 : -0.5) * found.track;
      for (const Wheel& w : side) {
        const double per_metre = w.direction / w.radius;
        jacobian.push_back({w.link, w.limits.velocity,
                            velocity_by_side(found, is_left) * (w.direction * w.radius / double(side.size())),
                            PlanarTwist{1, 0, -y} * per_metre, lowest_point(w), w.radius});
      }
    }
    return jacobian;
  }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<DifferentialDrive>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_differential_drive", .version = description.version, .licence = "MIT",
            .summary = "Kinematic motion of wheeled vehicles with differential drive", .algorithms = algorithms)
