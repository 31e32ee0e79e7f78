// SPDX-License-Identifier: MIT
// From the wanted velocity of a base to the velocities of its wheels: the inverse of motion.differential_drive, and the
// same with an effective track for vehicles that skid when they turn (Mandow et al., Experimental kinematics for
// wheeled skid-steer mobile robots, IROS 2007: the wheels act as if they stood farther apart).
#include "muro/plugin.hpp"
#include "muro/wheels.hpp"

namespace {

using namespace muro;

constexpr Parameter left = texts("left", "joints of the left wheels; default: as the model has them");
constexpr Parameter right = texts("right", "joints of the right wheels; default: as the model has them");
constexpr Parameter wheel_radius =
    real("wheel_radius", "m", 0, "of every wheel; 0: of the wheels' shapes").between(0, 1e3);
constexpr Parameter track =
    real("track", "m", 0, "between the left and the right wheels; 0: between their centres in the model")
        .between(0, 1e3);
constexpr Parameter max_wheel_speed =
    real("max_wheel_speed", "rad/s", 1e9, "of every wheel; the limit of its joint holds as well").between(1e-6, 1e9);

constexpr Parameter differential_parameters[] = {left, right, wheel_radius, track, max_wheel_speed};
constexpr Parameter skid_steer_parameters[] = {
    left,
    right,
    wheel_radius,
    track,
    max_wheel_speed,
    real("track_scale", "1", 1, "effective track by track: above 1 where turning wheels slip sideways")
        .between(0.1, 10),
};
constexpr Use reads[] = {{"command.twist", "of the base: linear x and angular z"},
                         {"collision.shapes", "of the wheels; else visual.shapes"}};
constexpr Use writes[] = {{"joint.velocity.target", "of every driven wheel"}};

constexpr Description differential{
    .id = "drive.differential",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with a driven wheel on each side",
    .parameters = differential_parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
};
constexpr Description skid_steer{
    .id = "drive.skid_steer",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into wheel speeds of a vehicle with several driven wheels on each side",
    .parameters = skid_steer_parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
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
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
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
        excess = std::max(excess, std::abs(wheels_[k].speed(forward, turn)) / wheels_[k].max_speed);
      for (std::uint32_t k = r.wheels.begin; k < r.wheels.end; ++k)
        *wheels_[k].target = wheels_[k].speed(forward, turn) / excess;
    }
  }

 protected:
  virtual double track_scale(const Parameters&) const { return 1; }

 private:
  /// speed = per_forward * forward + per_turn * turn
  struct DrivenWheel {
    Out<double> target;
    double per_forward = 0;  ///< rad/m
    double per_turn = 0;     ///< rad/rad
    double max_speed = 0;    ///< rad/s
    double speed(double forward, double turn) const { return per_forward * forward + per_turn * turn; }
  };
  struct Robot {
    In<Twist> command;
    Range wheels;  ///< in wheels_
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const Wheels found =
        find_wheels(c, robot, {p.texts("left"), p.texts("right"), p.real("wheel_radius"), p.real("track")});
    Robot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    r.wheels.begin = std::uint32_t(wheels_.size());
    const double half_track = 0.5 * track_scale(p) * found.track;
    for (const bool on_left : {true, false})
      for (const Wheel& w : on_left ? found.left : found.right) {
        const double per_metre = w.direction / w.radius;
        const double y = found.middle.y() + (on_left ? half_track : -half_track);
        const double limit = std::min(w.limits.velocity, p.real("max_wheel_speed"));
        const ObjectId joint = robot.frames[w.frame].joint_object;
        if (!(limit > 0))
          throw Error("the joint `" + std::string(c.object_name(joint)) + "` has the velocity limit " +
                      std::to_string(limit) + "; a driven wheel needs one above 0, or none");
        wheels_.push_back({c.offer(joint, keys::joint_velocity_target), per_metre, -y * per_metre, limit});
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
