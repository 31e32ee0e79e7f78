// SPDX-License-Identifier: MIT
// From the wanted velocity of a base to the speeds of its mecanum or omni wheels: the inverse of motion.omni.
#include "plugins/common/wheels/omni.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/wheels/description.hpp"
#include "plugins/common/wheels/drive.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    all_wheels,
    roller_angle,
    wheel_radius,
    max_wheel_speed,
};
constexpr PropertyUse reads[] = {{"command.twist", "of the base: linear x and y, angular z"}, sizes};
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

class Omni final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it drives robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Robot& r = robots_[i];
      const PlanarTwist wanted{r.command->linear.x(), r.command->linear.y(), r.command->angular.z()};
      double excess = 1;
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)
        excess = std::max(excess, std::abs(wheels_[k].speed(wanted)) / wheels_[k].target.most);
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)  // all alike: the wanted path, slower
        *wheels_[k].target.speed = wheels_[k].speed(wanted) / excess;
    }
  }

 private:
  struct DrivenWheel {
    DriveTarget target;
    PlanarTwist asks;  ///< rad/s per m/s, m/s, rad/s
    double speed(const PlanarTwist& v) const { return asks.x * v.x + asks.y * v.y + asks.turn * v.turn; }
  };
  struct Robot {
    In<Twist> command;
    Range wheels;  ///< in wheels_
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const std::vector<OmniWheel> found =
        find_omni_wheels(c, robot, {p.texts(all_wheels.name), p.reals(roller_angle.name), p.real(wheel_radius.name)});
    shares_of(robot, found);  // says when they cannot move it in every direction
    Robot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    r.wheels = {std::uint32_t(wheels_.size()), std::uint32_t(wheels_.size() + found.size())};
    for (const OmniWheel& w : found) {
      wheels_.push_back({drive_of(c, robot, w.frame, w.limits), asks_of(w)});
    }
    robots_.push_back(r);
  }

  std::vector<Robot> robots_;
  std::vector<DrivenWheel> wheels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Omni>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_omni", .version = "1.0.0", .licence = "MIT",
            .summary = "Drive of vehicles with mecanum or omni wheels", .algorithms = algorithms)
