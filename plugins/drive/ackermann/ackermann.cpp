// SPDX-License-Identifier: MIT
// From the wanted velocity of a base to angles of steered and speeds of driven wheels: the inverse of motion.ackermann.
// Every wheel stands across to the line from its centre to the one point about which the vehicle turns (R. Ackermann's
// condition).
#include "muro/plugin.hpp"
#include "plugins/common/wheels/description.hpp"
#include "plugins/common/wheels/drive.hpp"
#include "plugins/common/wheels/rolling.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

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
    {"command.twist", "of the base: linear x and angular z, and linear y where all wheels are steered"}, sizes};
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

/// A wheel, and where it may stand.
struct DriveWheel {
  PlanarWheel plane;
  std::int32_t steering = -1;   ///< among the robot's; -1: none
  double straight = 0;          ///< rad: its heading where the angle of what steers it is 0
  double gain = 1;              ///< its heading by this angle
  double lower = 0, upper = 0;  ///< rad: its heading stays between
  DriveTarget target{};         ///< when driven

  double across(double heading, const PlanarTwist& v) const {
    return plane.across(std::sin(heading), std::cos(heading), v, 0);
  }
  double along(double heading, const PlanarTwist& v) const {
    return plane.along(std::sin(heading), std::cos(heading), v, 0);
  }
  /// The heading (rad) nearest to straight ahead at which the wheel does not slip across.
  double heading_at(const PlanarTwist& v) const {
    const double vx = v.x - v.turn * plane.y, vy = v.y + v.turn * plane.x, size = std::hypot(vx, vy);
    if (size == 0) return straight;
    const double course = std::atan2(vy, vx), off = std::asin(std::clamp(v.turn * plane.ahead / size, -1.0, 1.0));
    const double a = std::remainder(course + off - straight, 2 * M_PI);
    const double b = std::remainder(course + M_PI - off - straight, 2 * M_PI);
    return straight + (std::abs(a) <= std::abs(b) ? a : b);
  }
  /// The part of `more`, 0 .. 1, that can be added to `v` before the wheel stands at a limit.
  double room(const PlanarTwist& v, const PlanarTwist& more) const {
    double part = 1;
    for (const bool up : {false, true}) {
      const double limit = up ? upper : lower;
      if (!std::isfinite(limit)) continue;
      const double turning = across(limit, more), reached = -across(limit, v) / turning;
      if (!(reached >= 0 && reached < part)) continue;
      const bool turns_up = turning * along(limit, v + more * reached) > 0;
      if (turns_up == up) part = reached;
    }
    return part;
  }
};

struct DriveSteering {
  Out<double> target;
  double lower = 0, upper = 0;  ///< rad
  double wheels = 0;            ///< how many it steers
};

class Ackermann final : public Algorithm {
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
    for (std::uint32_t i = range.begin; i < range.end; ++i) drive(robots_[i]);
  }

 private:
  struct Robot {
    In<Twist> command;
    bool all_steered = true;
    double axle = 0;         ///< m, x in the frame of the base: of the wheels that are not steered
    Range wheels, steering;  ///< in wheels_, steering_
  };

  std::span<const DriveWheel> wheels_of(const Robot& r) const {
    return {wheels_.data() + r.wheels.begin, r.wheels.end - r.wheels.begin};
  }

  /// What of the command can be driven. When limits of steering leave no room for all of it, the path is as near to the
  /// wanted one as they allow: less turning at the same speed.
  struct Course {
    PlanarTwist velocity;
    bool moves = false;  ///< else the wheels only take its angles
  };
  Course course_of(const Robot& r) const {
    const double turn = r.command->angular.z();
    const PlanarTwist parts[] = {{0, r.all_steered ? r.command->linear.y() : 0, 0}, {0, -turn * r.axle, turn}};
    Course course{{r.command->linear.x(), 0, 0}, r.command->linear.x() != 0};
    for (const PlanarTwist& more : parts) {
      if (more == PlanarTwist{}) continue;
      if (!course.moves) course.velocity.x = 1e-9 * (std::abs(more.y) + std::abs(more.turn));
      double part = 1;
      for (const DriveWheel& w : wheels_of(r))
        if (w.steering >= 0) part = std::min(part, w.room(course.velocity, more));
      if (part == 1 && !course.moves)
        course = {more, true};
      else
        course.velocity = course.velocity + more * part;
    }
    return course;
  }

  void drive(const Robot& r) const {
    const Course course = course_of(r);
    const PlanarTwist& v = course.velocity;
    if (!(v == PlanarTwist{}))  // at rest wheels stay as they are steered
      for (std::uint32_t k = r.steering.begin; k < r.steering.end; ++k) *steering_[k].target = 0;
    double excess = 1;
    for (const DriveWheel& w : wheels_of(r)) {
      const double heading = w.steering >= 0 ? w.heading_at(v) : w.straight;
      if (w.steering >= 0 && !(v == PlanarTwist{})) {
        const DriveSteering& s = steering_[r.steering.begin + std::uint32_t(w.steering)];
        *s.target += std::clamp((heading - w.straight) / w.gain, s.lower, s.upper) / s.wheels;
      }
      if (!w.target.speed) continue;
      *w.target.speed = course.moves ? w.plane.per_metre * w.along(heading, v) : 0;
      excess = std::max(excess, std::abs(*w.target.speed) / w.target.most);
    }
    for (const DriveWheel& w : wheels_of(r))  // all alike: the path keeps its curvature
      if (w.target.speed) *w.target.speed /= excess;
  }

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const std::vector<SteeredWheel> found =
        find_steered_wheels(c, robot,
                            {p.texts(steering_joints.name), p.texts(driven_wheels.name), p.texts(rolling_wheels.name),
                             p.real(wheel_radius.name)});
    Robot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    r.wheels.begin = std::uint32_t(wheels_.size());
    r.steering.begin = std::uint32_t(steering_.size());
    std::vector<std::size_t> steers;  // frames of the robot's steering joints
    double fixed = 0;
    for (const SteeredWheel& of : found) {
      DriveWheel w{.plane = PlanarWheel(of)};
      w.straight = w.plane.straight;
      if (of.steering < 0) {
        r.axle += w.plane.x, ++fixed;
      } else {
        const Link& joint = robot.links[std::size_t(of.steering)];
        const bool follows = joint.mimic >= 0;
        const std::size_t leader = follows ? std::size_t(joint.mimic) : std::size_t(of.steering);
        w.gain = of.sense * (follows ? joint.mimic_multiplier : 1);
        w.straight += follows ? of.sense * joint.mimic_offset : 0;
        if (w.gain == 0)
          throw Error("the joint `" + std::string(c.object_name(joint.joint_object)) +
                      "` follows another with the multiplier 0, so it cannot steer; give it one that is not 0");
        const auto known = std::find(steers.begin(), steers.end(), leader);
        w.steering = std::int32_t(known - steers.begin());
        if (known == steers.end()) {
          steers.push_back(leader);
          steering_.push_back(steering_of(c, robot.links[leader]));
        }
        DriveSteering& s = steering_[r.steering.begin + std::size_t(w.steering)];
        ++s.wheels;
        std::tie(w.lower, w.upper) = std::minmax({w.straight + w.gain * s.lower, w.straight + w.gain * s.upper});
      }
      if (of.driven) w.target = drive_of(c, robot, of.frame, of.limits);
      wheels_.push_back(w);
    }
    r.all_steered = fixed == 0;
    if (!r.all_steered) r.axle /= fixed;
    r.wheels.end = std::uint32_t(wheels_.size());
    r.steering.end = std::uint32_t(steering_.size());
    robots_.push_back(r);
  }

  static DriveSteering steering_of(Connector& c, const Link& f) {
    const double most = c.parameters().real("max_steering_angle");
    const bool limited = most < 1e9;
    return {c.optional_output(f.joint_object, keys::joint_position_target),
            limited ? std::max(f.limits.lower, -most) : f.limits.lower,
            limited ? std::min(f.limits.upper, most) : f.limits.upper, 0};
  }

  std::vector<Robot> robots_;
  std::vector<DriveWheel> wheels_;
  std::vector<DriveSteering> steering_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Ackermann>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_ackermann", .version = "1.0.0", .licence = "MIT",
            .summary = "Drive of vehicles with steered wheels", .algorithms = algorithms)
