// SPDX-License-Identifier: MIT
// Turns the commanded velocity of a base into the speeds of its mecanum or omni wheels: the inverse of motion.omni.
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/wheels/drive_target.hpp"
#include "plugins/common/wheels/motion_description.hpp"
#include "plugins/common/wheels/omni_jacobian.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {
    all_wheels,
    roller_angle,
    wheel_radius,
    max_wheel_speed,
};
constexpr PropertyUse reads[] = {{"command.twist", "of the base: linear x and y, angular z"}, reads_wheel_shapes};
constexpr PropertyUse writes[] = {{"joint.velocity.target", "of every wheel"}};
constexpr Description description{
    .id = "drive.omni",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with mecanum or omni wheels",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one robot.
struct OmniRobot {
  struct Wheel {
    DriveTarget target;
    PlanarTwist inverse_jacobian_row;
  };
  In<Twist> command;
  Range wheels;
};

class Omni final : public PerRobotAlgorithm<OmniRobot> {
 public:
  void step(const Step&, Range range) override {
    for (const OmniRobot& r : robots(range)) {
      const PlanarTwist wanted{r.command->linear.x(), r.command->linear.y(), r.command->angular.z()};
      const std::span<OmniRobot::Wheel> wheels = wheels_[r.wheels];
      for (const OmniRobot::Wheel& w : wheels) *w.target.speed = dot(w.inverse_jacobian_row, wanted);
      limit_speeds(wheels);
    }
  }

 private:
  OmniRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    const std::vector<OmniWheel> found = find_omni_wheels(c, robot);
    jacobian_columns(robot, found);  // throws when the wheels cannot move the robot in every direction
    OmniRobot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    std::vector<OmniRobot::Wheel> wheels;
    for (const OmniWheel& w : found)
      wheels.push_back({connect_drive_target(c, robot, w.link, w.limits), inverse_jacobian_row(w)});
    r.wheels = wheels_.add(wheels);
    return r;
  }

  PackedLists<OmniRobot::Wheel> wheels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Omni>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_omni", .version = description.version, .licence = "MIT",
            .summary = "Drive of vehicles with mecanum or omni wheels", .algorithms = algorithms)
