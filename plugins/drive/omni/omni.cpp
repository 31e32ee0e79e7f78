// SPDX-License-Identifier: MIT
// From the wanted velocity of a base to the speeds of its mecanum or omni wheels: the inverse of motion.omni.
#include "plugins/wheeled/omni.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    texts("wheels", "joints of the wheels; default: as the model has them"),
    reals("roller_angle", "rad", {},
          "from a wheel's rolling direction to the axis of the roller on the ground: one for all, or one a wheel; "
          "default: mecanum (pi/4) or omni wheels (0), as they stand"),
    real("wheel_radius", "m", 0, "of every wheel; 0: of the wheels' shapes").between(0, 1e3),
    real("max_wheel_speed", "rad/s", 1e9, "of every wheel; the limit of its joint holds as well").between(1e-6, 1e9),
};
constexpr Use reads[] = {{"command.twist", "of the base: linear x and y, angular z"},
                         {"collision.shapes", "of the wheels; else visual.shapes"}};
constexpr Use writes[] = {{"joint.velocity.target", "of every wheel"}};
constexpr Description description{
    .id = "drive.omni",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with mecanum or omni wheels",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
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
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
    return phases;
  }

  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Robot& r = robots_[i];
      const PlanarTwist wanted{r.command->linear.x(), r.command->linear.y(), r.command->angular.z()};
      double excess = 1;
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)
        excess = std::max(excess, std::abs(wheels_[k].speed(wanted)) / wheels_[k].max_speed);
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)  // all alike: the wanted path, slower
        *wheels_[k].target = wheels_[k].speed(wanted) / excess;
    }
  }

 private:
  struct DrivenWheel {
    Out<double> target;
    PlanarTwist asks;      ///< rad/s per m/s, m/s, rad/s
    double max_speed = 0;  ///< rad/s
    double speed(const PlanarTwist& v) const { return asks.x * v.x + asks.y * v.y + asks.turn * v.turn; }
  };
  struct Robot {
    In<Twist> command;
    Range wheels;  ///< in wheels_
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const std::vector<OmniWheel> found =
        find_omni_wheels(c, robot, {p.texts("wheels"), p.reals("roller_angle"), p.real("wheel_radius")});
    shares_of(robot, found);  // says when they cannot move it in every direction
    Robot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    r.wheels = {std::uint32_t(wheels_.size()), std::uint32_t(wheels_.size() + found.size())};
    for (const OmniWheel& w : found) {
      const double limit = std::min(w.limits.velocity, p.real("max_wheel_speed"));
      const ObjectId joint = robot.frames[w.frame].joint_object;
      if (!(limit > 0))
        throw Error("the joint `" + std::string(c.object_name(joint)) + "` has the velocity limit " +
                    std::to_string(limit) + "; a driven wheel needs one above 0, or none");
      wheels_.push_back({c.offer(joint, keys::joint_velocity_target), asks_of(w), limit});
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
