// SPDX-License-Identifier: MIT
// Vehicles with mecanum or omni wheels: three or more wheels with rollers. Their speeds give any velocity in the plane.
#include "plugins/common/wheels/omni_jacobian.hpp"
#include "plugins/motion/common/wheel_motion/wheel_motion.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {
    all_wheels, roller_angle, wheel_radius, max_wheel_acceleration, on_contact,
};
constexpr Description description{
    .id = "motion.omni",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base along exact arcs in a plane as its mecanum or omni wheels turn; no forces, no slip",
    .parameters = parameters,
    .reads = wheel_motion_reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = wheel_motion_features,
};

class Omni final : public WheelMotion {
  std::vector<WheelJacobian> jacobian_of(const Connector& c, const RobotView& robot) const override {
    const std::vector<OmniWheel> found = find_omni_wheels(c, robot);
    const std::vector<PlanarTwist> columns = jacobian_columns(robot, found);
    std::vector<WheelJacobian> jacobian;
    for (std::size_t i = 0; i < found.size(); ++i)
      jacobian.push_back({found[i].link, found[i].limits.velocity, columns[i], inverse_jacobian_row(found[i]),
                          lowest_point(found[i]), found[i].radius});
    return jacobian;
  }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Omni>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_omni", .version = description.version, .licence = "MIT",
            .summary = "Kinematic motion of vehicles with mecanum or omni wheels", .algorithms = algorithms)
