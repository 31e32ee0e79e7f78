// SPDX-License-Identifier: MIT
// From the commanded velocity of a base to angles of steered and speeds of driven wheels: the inverse of
// motion.ackermann. Every wheel stands at right angles to the line from its centre to the one point about which the
// vehicle turns (R. Ackermann's condition).
#include "muro/base/elementary.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/wheels/drive_target.hpp"
#include "plugins/common/wheels/motion_description.hpp"
#include "plugins/common/wheels/steering_geometry.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr Parameter parameters[] = {
    steering_joints,
    driven_wheels,
    rolling_wheels,
    wheel_radius,
    max_wheel_speed,
    real("max_steering_angle", "rad", 1e9, "of every joint that steers, either way; its own limits hold as well")
        .between(1e-6, 1e9),
};
constexpr PropertyUse reads[] = {
    {"command.twist", "of the base: linear x and angular z, and linear y where all wheels are steered"},
    reads_wheel_shapes};
constexpr PropertyUse writes[] = {{"joint.position.target", "of every joint that steers"},
                                  {"joint.velocity.target", "of every driven wheel"}};
constexpr Description description{
    .id = "drive.ackermann",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Turns a base command into steering angles and wheel speeds of a vehicle with steered wheels",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// A wheel, and the headings that its steering allows.
struct DriveWheel {
  PlanarWheel plane;
  WheelSteering steering{};
  double lower = 0, upper = 0;  ///< rad, limits of its heading
  DriveTarget target{};         ///< when driven

  double lateral_velocity(double heading, const PlanarTwist& v) const {
    const auto [sine, cosine] = elementary::sincos(heading);
    return plane.lateral_velocity(sine, cosine, v, 0);
  }
  double longitudinal_velocity(double heading, const PlanarTwist& v) const {
    const auto [sine, cosine] = elementary::sincos(heading);
    return plane.longitudinal_velocity(sine, cosine, v, 0);
  }
  /// Returns the heading (rad) nearest to straight ahead at which the wheel does not slip sideways.
  double heading_at(const PlanarTwist& v) const {
    const double straight = steering.zero_heading;
    const double vx = v.x - v.yaw_rate * plane.y, vy = v.y + v.yaw_rate * plane.x, size = elementary::hypot(vx, vy);
    if (size == 0) return straight;
    const double direction = elementary::atan2(vy, vx);
    const double off = elementary::asin(std::clamp(v.yaw_rate * plane.forward_offset / size, -1.0, 1.0));
    const double forward = std::remainder(direction + off - straight, 2 * M_PI);
    const double backward = std::remainder(direction + M_PI - off - straight, 2 * M_PI);
    return straight + (std::abs(forward) <= std::abs(backward) ? forward : backward);
  }
  /// Returns the fraction of `more`, 0 .. 1, that can be added to `v` before the steering is at a limit.
  double feasible_fraction(const PlanarTwist& v, const PlanarTwist& more) const {
    double fraction = 1;
    for (const bool is_upper : {false, true}) {
      const double limit = is_upper ? upper : lower;
      if (!std::isfinite(limit)) continue;
      const double lateral = lateral_velocity(limit, more), reached = -lateral_velocity(limit, v) / lateral;
      if (!(reached >= 0 && reached < fraction)) continue;
      const bool passes_upward = lateral * longitudinal_velocity(limit, v + more * reached) > 0;
      if (passes_upward == is_upper) fraction = reached;
    }
    return fraction;
  }
};

struct DriveSteering {
  Out<double> target;
  double lower = 0, upper = 0;  ///< rad
  double wheel_count = 0;       ///< number of wheels that it steers
};

/// Data of one robot.
struct DrivenRobot {
  In<Twist> command;
  bool all_steered = true;
  double axle = 0;  ///< m, mean x of the wheels that are not steered, in the frame of the base
  Range wheels, steering;
};

class Ackermann final : public PerRobotAlgorithm<DrivenRobot> {
 public:
  void step(const Step&, Range range) override {
    for (const DrivenRobot& r : robots(range)) drive(r);
  }

 private:
  void read_parameters(const Parameters& p) override { max_steering_angle_ = p.real("max_steering_angle"); }

  DrivenRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    const std::vector<SteeredWheel> found = find_steered_wheels(c, robot);
    const SteeringGeometry geometry = steering_geometry(robot.links, found);
    DrivenRobot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    std::vector<DriveWheel> wheels;
    std::vector<DriveSteering> steering;
    for (const std::size_t link : geometry.joints) steering.push_back(connect_steering(c, robot.links[link]));
    double fixed_wheels = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      DriveWheel w{.plane = PlanarWheel(found[k]), .steering = geometry.wheels[k]};
      if (w.steering.joint < 0) {
        r.axle += w.plane.x, ++fixed_wheels;
      } else {
        const double zero = w.steering.zero_heading, gain = w.steering.gain;
        if (gain == 0)
          throw Error("the joint `" +
                      std::string(c.object_name(robot.links[std::size_t(found[k].steering)].joint_object)) +
                      "` follows another with the multiplier 0, so it cannot steer; give it one that is not 0");
        DriveSteering& s = steering[std::size_t(w.steering.joint)];
        ++s.wheel_count;
        std::tie(w.lower, w.upper) = std::minmax({zero + gain * s.lower, zero + gain * s.upper});
      }
      if (found[k].driven) w.target = connect_drive_target(c, robot, found[k].link, found[k].limits);
      wheels.push_back(w);
    }
    r.all_steered = fixed_wheels == 0;
    if (!r.all_steered) r.axle /= fixed_wheels;
    r.wheels = wheels_.add(wheels);
    r.steering = steering_.add(steering);
    return r;
  }

  DriveSteering connect_steering(Connector& c, const Link& link) const {
    const double limit = max_steering_angle_;
    const bool is_limited = limit < 1e9;
    return {c.optional_output(link.joint_object, keys::joint_position_target),
            is_limited ? std::max(link.limits.lower, -limit) : link.limits.lower,
            is_limited ? std::min(link.limits.upper, limit) : link.limits.upper, 0};
  }

  /// The part of the command that can be driven. When limits of the steering do not allow all of it, the vehicle turns
  /// less at the same speed: the path is as near to the wanted one as the limits allow.
  struct FeasibleMotion {
    PlanarTwist velocity;
    bool moves = false;  ///< false: the wheels only take its angles
  };
  FeasibleMotion feasible_motion(const DrivenRobot& r) const {
    const double yaw_rate = r.command->angular.z();
    const PlanarTwist contributions[] = {{0, r.all_steered ? r.command->linear.y() : 0, 0},
                                         {0, -yaw_rate * r.axle, yaw_rate}};
    FeasibleMotion motion{{r.command->linear.x(), 0, 0}, r.command->linear.x() != 0};
    for (const PlanarTwist& more : contributions) {
      if (more == PlanarTwist{}) continue;
      if (!motion.moves) motion.velocity.x = 1e-9 * (std::abs(more.y) + std::abs(more.yaw_rate));
      double fraction = 1;
      for (const DriveWheel& w : wheels_[r.wheels])
        if (w.steering.joint >= 0) fraction = std::min(fraction, w.feasible_fraction(motion.velocity, more));
      if (fraction == 1 && !motion.moves)
        motion = {more, true};
      else
        motion.velocity = motion.velocity + more * fraction;
    }
    return motion;
  }

  void drive(const DrivenRobot& r) const {
    const std::span<const DriveWheel> wheels = wheels_[r.wheels];
    const std::span<const DriveSteering> steering = steering_[r.steering];
    const FeasibleMotion motion = feasible_motion(r);
    const PlanarTwist& v = motion.velocity;
    const bool is_at_rest = v == PlanarTwist{};  // wheels then keep their headings
    if (!is_at_rest)
      for (const DriveSteering& s : steering) *s.target = 0;
    for (const DriveWheel& w : wheels) {
      const bool is_steered = w.steering.joint >= 0;
      const double heading = is_steered ? w.heading_at(v) : w.steering.zero_heading;
      if (is_steered && !is_at_rest) {
        const DriveSteering& s = steering[std::size_t(w.steering.joint)];
        *s.target +=
            std::clamp((heading - w.steering.zero_heading) / w.steering.gain, s.lower, s.upper) / s.wheel_count;
      }
      if (w.target.speed)
        *w.target.speed = motion.moves ? w.plane.angle_per_metre * w.longitudinal_velocity(heading, v) : 0;
    }
    limit_speeds(wheels);
  }

  double max_steering_angle_ = 1e9;
  PackedLists<DriveWheel> wheels_;
  PackedLists<DriveSteering> steering_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Ackermann>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_ackermann", .version = description.version, .licence = "MIT",
            .summary = "Drive of vehicles with steered wheels", .algorithms = algorithms)
