// SPDX-License-Identifier: MIT
// From the wanted velocity of a base to the velocities of its wheels: the inverse of motion.differential_drive, and the
// same with an effective track for vehicles that skid when they turn (Mandow et al., Experimental kinematics for
// wheeled skid-steer mobile robots, IROS 2007: the wheels act as if they stood farther apart).
#include "plugins/common/wheels/drive.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/wheels/description.hpp"
#include "plugins/common/wheels/side_wheels.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter differential_parameters[] = {left_wheels, right_wheels, wheel_radius, track, max_wheel_speed};
constexpr Parameter skid_steer_parameters[] = {
    left_wheels,
    right_wheels,
    wheel_radius,
    track,
    max_wheel_speed,
    real("track_scale", "1", 1, "effective track by track: above 1 where turning wheels slip sideways")
        .between(0.1, 10),
};
constexpr PropertyUse reads[] = {{"command.twist", "of the base: linear x and angular z"}, sizes};
constexpr PropertyUse writes[] = {{"joint.velocity.target", "of every driven wheel"}};

constexpr Description differential{
    .id = "drive.differential",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with a driven wheel on each side",
    .parameters = differential_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};
constexpr Description skid_steer{
    .id = "drive.skid_steer",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with several driven wheels on each side",
    .parameters = skid_steer_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Drive : public Algorithm {
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
      const double forward = r.command->linear.x(), turn = r.command->angular.z();
      // The slower of what is wanted and what the wheels can do, with the ratio of both sides kept: the path has the
      // wanted curvature.
      double excess = 1;
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)
        excess = std::max(excess, std::abs(wheels_[k].speed(forward, turn)) / wheels_[k].target.most);
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)
        *wheels_[k].target.speed = wheels_[k].speed(forward, turn) / excess;
    }
  }

 protected:
  virtual double track_scale(const Parameters&) const { return 1; }

 private:
  /// speed = per_forward * forward + per_turn * turn
  struct DrivenWheel {
    DriveTarget target;
    double per_forward = 0;  ///< rad/m
    double per_turn = 0;     ///< rad/rad
    double speed(double forward, double turn) const { return per_forward * forward + per_turn * turn; }
  };
  struct Robot {
    In<Twist> command;
    Range wheels;  ///< in wheels_
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const Wheels found = find_wheels(
        c, robot,
        {p.texts(left_wheels.name), p.texts(right_wheels.name), p.real(wheel_radius.name), p.real(track.name)});
    Robot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    r.wheels.begin = std::uint32_t(wheels_.size());
    const double half_track = 0.5 * track_scale(p) * found.track;
    for (const bool on_left : {true, false})
      for (const Wheel& w : on_left ? found.left : found.right) {
        const double per_metre = w.direction / w.radius;
        const double y = found.middle.y() + (on_left ? half_track : -half_track);
        wheels_.push_back({drive_of(c, robot, w.frame, w.limits), per_metre, -y * per_metre});
      }
    r.wheels.end = std::uint32_t(wheels_.size());
    robots_.push_back(r);
  }

  std::vector<Robot> robots_;
  std::vector<DrivenWheel> wheels_;
};

class Differential final : public Drive {};

class SkidSteer final : public Drive {
  double track_scale(const Parameters& p) const override { return p.real("track_scale"); }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Differential>(differential), algorithm<SkidSteer>(skid_steer)};

}  // namespace

MURO_PLUGIN(.name = "drive", .version = "1.0.0", .licence = "MIT", .summary = "Drives of wheeled vehicles",
            .algorithms = algorithms)
