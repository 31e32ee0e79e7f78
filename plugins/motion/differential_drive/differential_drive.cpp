// SPDX-License-Identifier: MIT
// Differential drive (MuRoSimF, Section 3.1): the wheels of both sides roll on a plane and never slip along it, so the
// velocity of the base follows from those of the wheels. Kinematics after Siegwart, Nourbakhsh and Scaramuzza,
// Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.
#include "muro/composite.hpp"
#include "muro/plugin.hpp"
#include "muro/wheels.hpp"
#include "planar.hpp"
#include "ramp.hpp"

namespace {

using namespace muro;
using namespace muro::differential_drive;

constexpr Parameter parameters[] = {
    texts("left", "joints of the left wheels; default: as the model has them"),
    texts("right", "joints of the right wheels; default: as the model has them"),
    real("wheel_radius", "m", 0, "of every wheel; 0: of the wheels' shapes").between(0, 1e3),
    real("track", "m", 0, "between the left and the right wheels; 0: between their centres in the model")
        .between(0, 1e3),
    real("max_wheel_acceleration", "rad/s^2", unlimited, "of every wheel; 1e9: none, the speed jumps")
        .between(1e-6, unlimited),
};
constexpr Use reads[] = {
    {"joint.velocity.target", "of every joint that follows no other"},
    {"pose.initial", "of the base"},
    {"twist.initial", "of the base; what wheels can follow of it is their speed at the start"},
    {"joint.position.initial", "of every joint, optional"},
    {"collision.shapes", "of the wheels; else visual.shapes"},
};
constexpr Use writes[] = {{"pose", "of the base"},
                          {"twist", "of the base"},
                          {"joint.position", "of every joint"},
                          {"joint.velocity", "of every joint"}};
constexpr Description description{
    .id = "motion.differential_drive",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary =
        "Moves the base along exact arcs in a plane as its left and right wheels turn; no forces, no slip along the "
        "way",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
};

class DifferentialDrive final : public Algorithm {
 public:
  void connect(Connector& c) override {
    max_acceleration_ = c.parameters().real("max_wheel_acceleration");
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it moves robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
    return phases;
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Robot& r = robots_[i];
      const std::span<DrivenWheel> wheels(wheels_.data() + r.wheels.begin, r.wheels.end - r.wheels.begin);
      for (DrivenWheel& w : wheels)
        w.ramp = ramp(*w.velocity, std::clamp(*w.target, -w.max_speed, w.max_speed), max_acceleration_, step.dt);
      move_base(r, wheels, step.dt);
      for (const DrivenWheel& w : wheels) {
        *w.position += w.ramp.angle(step.dt);
        *w.velocity = w.ramp.last;
      }
      for (std::uint32_t k = r.joints.begin; k < r.joints.end; ++k) move_joint(joints_[k], step.dt);
      for (std::uint32_t k = r.followers.begin; k < r.followers.end; ++k) followers_[k].follow();
    }
  }

 private:
  struct DrivenWheel {
    In<double> target;
    Out<double> position, velocity;
    double max_speed = 0;  ///< rad/s
    PlanarTwist share;     ///< velocity of the base per rad/s of this wheel
    Ramp ramp;             ///< of the present step
  };
  struct Joint {
    In<double> target;
    Out<double> position, velocity;
    JointLimits limits;
  };
  struct Follower {
    Out<double> leader_position, leader_velocity, position, velocity;
    double multiplier = 1, offset = 0;
    void follow() const {
      *position = offset + multiplier * *leader_position;
      *velocity = multiplier * *leader_velocity;
    }
  };
  struct Robot {
    Out<Pose> pose;
    Out<Twist> twist;
    Range wheels, joints, followers;  ///< in wheels_, joints_, followers_
    std::string_view name;
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const Wheels wheels =
        find_wheels(c, robot, {p.texts("left"), p.texts("right"), p.real("wheel_radius"), p.real("track")});
    const Pose start = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist moving = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    Robot r;
    r.name = robot.name;
    r.pose = c.variable(robot.base(), keys::pose, start);
    const std::vector<double> positions = initial_joint_positions(c, robot);
    std::vector<Out<double>> position(robot.frames.size()), velocity(robot.frames.size());
    std::vector<bool> driven(robot.frames.size(), false);

    r.wheels = {std::uint32_t(wheels_.size()),
                std::uint32_t(wheels_.size() + wheels.left.size() + wheels.right.size())};
    PlanarTwist rolling;
    for (const bool left : {true, false}) {
      const std::vector<Wheel>& side = left ? wheels.left : wheels.right;
      for (const Wheel& wheel : side) {
        const Frame& f = robot.frames[wheel.frame];
        const double speed = initial_speed(wheels, wheel, left, start, moving);
        DrivenWheel w;
        w.target = c.input(f.joint_object, keys::joint_velocity_target, 0.0);
        w.position = position[wheel.frame] = c.variable(f.joint_object, keys::joint_position, positions[wheel.frame]);
        w.velocity = velocity[wheel.frame] = c.variable(f.joint_object, keys::joint_velocity, speed);
        w.max_speed = wheel.limits.velocity;
        w.share = share_of(wheels, left) * (wheel.direction * wheel.radius / double(side.size()));
        rolling = rolling + w.share * speed;
        driven[wheel.frame] = true;
        wheels_.push_back(w);
      }
    }
    r.twist = c.variable(robot.base(), keys::twist, in_world(start, rolling));

    r.joints = {std::uint32_t(joints_.size()), std::uint32_t(joints_.size())};
    for (std::size_t i = 0; i < robot.frames.size(); ++i) {
      const Frame& f = robot.frames[i];
      if (f.joint == JointKind::fixed || driven[i]) continue;
      position[i] = c.variable(f.joint_object, keys::joint_position, positions[i]);
      velocity[i] = c.variable(f.joint_object, keys::joint_velocity, 0.0);
      if (f.mimic >= 0) continue;
      check_start(c, f, positions[i]);
      joints_.push_back(
          {c.input(f.joint_object, keys::joint_velocity_target, 0.0), position[i], velocity[i], f.limits});
      ++r.joints.end;
    }
    r.followers = {std::uint32_t(followers_.size()), std::uint32_t(followers_.size())};
    for (std::size_t i = 0; i < robot.frames.size(); ++i) {
      const Frame& f = robot.frames[i];
      if (f.mimic < 0) continue;
      const auto leader = std::size_t(f.mimic);
      followers_.push_back(
          {position[leader], velocity[leader], position[i], velocity[i], f.mimic_multiplier, f.mimic_offset});
      ++r.followers.end;
    }
    robots_.push_back(r);
  }

  static void check_start(const Connector& c, const Frame& f, double position) {
    if (position < f.limits.lower || position > f.limits.upper)
      throw Error("joint `" + std::string(c.object_name(f.joint_object)) + "` starts at " + std::to_string(position) +
                  ", outside of its limits " + std::to_string(f.limits.lower) + " to " +
                  std::to_string(f.limits.upper) + "; set `joint.position.initial` to a value between them");
  }

  /// Velocity of the base when one side moves over the ground at 1 m/s and the other stands still. The base turns
  /// about a point on the line through the wheels' centres, wherever on the robot its own origin is.
  static PlanarTwist share_of(const Wheels& wheels, bool left) {
    const double turn = (left ? -1 : 1) / wheels.track;
    return {0.5 + turn * wheels.middle.y(), -turn * wheels.middle.x(), turn};
  }

  /// Velocity (rad/s) of the wheel's joint at which the base moves at `moving` (world axes), as far as wheels allow.
  static double initial_speed(const Wheels& wheels, const Wheel& wheel, bool left, const Pose& start,
                              const Twist& moving) {
    const double turn = (start.orientation.conjugate() * moving.angular).z();
    const double forward = (start.orientation.conjugate() * moving.linear).x() - turn * wheels.middle.y();
    const double ground = forward + (left ? -0.5 : 0.5) * turn * wheels.track;
    return std::clamp(wheel.direction * ground / wheel.radius, -wheel.limits.velocity, wheel.limits.velocity);
  }

  static Twist in_world(const Pose& pose, const PlanarTwist& v) {
    return {pose.orientation * Vec3(v.x, v.y, 0), pose.orientation * Vec3(0, 0, v.turn)};
  }

  /// All wheels' velocities are linear in time between the ends of their ramps: from each end to the next one goes an
  /// arc, or, while wheels speed up, a curve.
  static void move_base(const Robot& r, std::span<const DrivenWheel> wheels, double dt) {
    Pose& pose = *r.pose;
    PlanarTwist velocity;
    for (double from = 0, to = 0; from < dt; from = to) {
      to = dt;
      velocity = {};
      PlanarTwist rate;
      for (const DrivenWheel& w : wheels) {
        velocity = velocity + w.share * w.ramp.at(from);
        rate = rate + w.share * w.ramp.acceleration_at(from);
        if (w.ramp.end > from && w.ramp.end < to) to = w.ramp.end;
      }
      pose = pose * (rate == PlanarTwist{} ? arc(velocity, to - from) : curve(velocity, rate, to - from));
      velocity = velocity + rate * (to - from);
    }
    pose.orientation.normalize();
    *r.twist = in_world(pose, velocity);
    if (!std::isfinite(velocity.x + velocity.turn))
      throw Error("a wheel of `" + std::string(r.name) +
                  "` is to turn at a speed that is not finite; look at what writes "
                  "`joint.velocity.target`");
  }

  static void move_joint(const Joint& j, double dt) {
    const double v = std::clamp(*j.target, -j.limits.velocity, j.limits.velocity);
    const double reached = *j.position + v * dt;
    *j.position = std::clamp(reached, j.limits.lower, j.limits.upper);
    *j.velocity = *j.position == reached ? v : 0;
  }

  double max_acceleration_ = unlimited;
  std::vector<Robot> robots_;
  std::vector<DrivenWheel> wheels_;
  std::vector<Joint> joints_;
  std::vector<Follower> followers_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<DifferentialDrive>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_differential_drive", .version = "1.0.0", .licence = "MIT",
            .summary = "Kinematic motion of wheeled vehicles with differential drive", .algorithms = algorithms)
