// SPDX-License-Identifier: MIT
// Vehicles with steered wheels: their angles give the centre about which the base turns, driven wheels the speed.
// Siegwart, Nourbakhsh and Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.
#include "muro/toolkit/contact_stop.hpp"
#include "plugins/common/wheels/description.hpp"
#include "plugins/common/wheels/other_joints.hpp"
#include "plugins/common/wheels/parameters.hpp"
#include "steered_vehicle.hpp"

namespace {

using namespace muro;
using namespace muro::wheeled;

constexpr Parameter parameters[] = {
    steering_joints,
    driven_wheels,
    rolling_wheels,
    wheel_radius,
    real("max_steering_rate", "rad/s", unlimited, "of every joint that steers, beside its own limit; 1e9: none")
        .between(1e-6, unlimited),
    max_wheel_acceleration,
    on_contact,
};
constexpr PropertyUse reads[] = {
    {"joint.position.target", "of every joint that steers"},
    {"joint.velocity.target", "of every driven wheel, and of every other joint that follows no other"},
    starts_at,
    starts_with,
    joints_start_at,
    sizes,
    on_contact_reads,
};
constexpr Description description{
    .id = "motion.ackermann",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base along exact arcs in a plane as its wheels are steered and driven; no forces, no slip",
    .parameters = parameters,
    .reads = reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_position_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_mimic_joints,
};

class Ackermann final : public Algorithm {
 public:
  void connect(Connector& c) override {
    max_acceleration_ = c.parameters().real(max_wheel_acceleration.name);
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it moves robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      move(robots_[i], step.dt);
      others_.move(i, step.dt);
    }
  }

  /// The wheels turn as fits the base's velocity best; the steering goes on from where it stands.
  void on_handover(std::uint32_t item) override {
    const Robot& r = robots_[item];
    const PlanarTwist moving = in_plane(*r.pose, *r.twist);
    for (const Steering& s : steering_of(r)) *s.velocity = 0;
    for (VehicleWheel& w : wheels_of(r)) {
      if (w.steering >= 0) w.stand_at(*steering_of(r)[std::size_t(w.steering)].position, 0);
      *w.velocity = std::clamp(w.speed_at(moving), -w.max_speed, w.max_speed);
    }
  }

 private:
  struct Robot {
    Out<Pose> pose;
    Out<Twist> twist;
    RollingBase base;
    Range wheels, steering;  ///< in wheels_, steering_
    std::string_view name;
    ContactStop stop{};
  };

  std::span<VehicleWheel> wheels_of(const Robot& r) {
    return {wheels_.data() + r.wheels.begin, r.wheels.end - r.wheels.begin};
  }
  std::span<Steering> steering_of(const Robot& r) {
    return {steering_.data() + r.steering.begin, r.steering.end - r.steering.begin};
  }

  void connect_robot(Connector& c, const RobotView& robot) {
    const Parameters& p = c.parameters();
    const std::vector<SteeredWheel> found =
        find_steered_wheels(c, robot,
                            {p.texts(steering_joints.name), p.texts(driven_wheels.name), p.texts(rolling_wheels.name),
                             p.real(wheel_radius.name)});
    const Pose start = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist moving = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    const std::vector<double> positions = initial_joint_positions(c, robot);
    JointState state(robot);
    const auto bind = [&](std::size_t frame, double speed) {
      const ObjectId joint = robot.links[frame].joint_object;
      state.position[frame] = c.variable(joint, keys::joint_position, positions[frame]);
      state.velocity[frame] = c.variable(joint, keys::joint_velocity, speed);
    };

    std::vector<PlanarWheel> planes(found.begin(), found.end());
    Robot r{c.variable(robot.base(), keys::pose, start), {}, RollingBase(planes), {}, {}, robot.name};
    r.wheels = {std::uint32_t(wheels_.size()), std::uint32_t(wheels_.size() + found.size())};
    r.steering = {std::uint32_t(steering_.size()), std::uint32_t(steering_.size())};
    std::vector<std::size_t> steers;  // frames of the robot's steering joints
    for (std::size_t k = 0; k < found.size(); ++k) {
      const SteeredWheel& of = found[k];
      VehicleWheel w{.plane = planes[k], .straight = planes[k].straight, .driven = of.driven};
      w.max_speed = of.driven ? of.limits.velocity : std::numeric_limits<double>::infinity();
      w.stand_at(0, 0);
      if (of.steering >= 0) {
        const Link& joint = robot.links[std::size_t(of.steering)];
        const bool follows = joint.mimic >= 0;
        const std::size_t leader = follows ? std::size_t(joint.mimic) : std::size_t(of.steering);
        w.gain = of.sense * (follows ? joint.mimic_multiplier : 1);
        w.straight += follows ? of.sense * joint.mimic_offset : 0;
        const auto known = std::find(steers.begin(), steers.end(), leader);
        w.steering = std::int32_t(known - steers.begin());
        if (known == steers.end()) {
          bind(leader, 0);
          steers.push_back(leader);
          steering_.push_back(steering_of_joint(c, robot.links[leader], positions[leader]));
          steering_.back().position = state.position[leader];
          steering_.back().velocity = state.velocity[leader];
        }
        w.stand_at(positions[leader], 0);
      }
      const double speed = std::clamp(w.speed_at(in_plane(start, moving)), -w.max_speed, w.max_speed);
      w.rolling.speed = speed / w.plane.per_metre;
      if (w.driven) w.target = c.input(robot.links[of.frame].joint_object, keys::joint_velocity_target, 0.0);
      bind(of.frame, speed);
      w.position = state.position[of.frame], w.velocity = state.velocity[of.frame];
      wheels_.push_back(w);
    }
    r.steering.end = std::uint32_t(steering_.size());
    const PlanarTwist rolling = SteeredVehicle(r.base, wheels_of(r), steering_of(r)).velocity().velocity;
    r.twist = c.variable(robot.base(), keys::twist, in_world(start, rolling));
    others_.connect(c, robot, positions, state);
    r.stop = ContactStop(c, robot);
    robots_.push_back(r);
  }

  static Steering steering_of_joint(Connector& c, const Link& f, double position) {
    check_start(c, f.joint_object, f.limits, position);
    Steering s;
    s.target = c.input(f.joint_object, keys::joint_position_target, position);
    s.limits = f.limits;
    s.max_rate = std::min(f.limits.velocity, c.parameters().real("max_steering_rate"));
    return s;
  }

  void move(const Robot& r, double dt) {
    const std::span<VehicleWheel> wheels = wheels_of(r);
    const std::span<Steering> steering = steering_of(r);
    double all = 0;
    for (Steering& s : steering) s.begin(dt), all += s.last;
    for (VehicleWheel& w : wheels) {
      if (!w.driven) continue;
      w.ramp = ramp(*w.velocity, std::clamp(*w.target, -w.max_speed, w.max_speed), max_acceleration_, dt);
      all += w.ramp.last;
    }
    if (!std::isfinite(all))
      throw Error("a joint of `" + std::string(r.name) +
                  "` is to turn at a speed or to an angle that is not finite; look at what writes "
                  "`joint.velocity.target` and `joint.position.target`");
    const Pose before = *r.pose;
    const PlanarTwist velocity = SteeredVehicle(r.base, wheels, steering).move(*r.pose, r.twist->angular.norm(), dt);
    r.pose->orientation.normalize();
    *r.twist = in_world(*r.pose, velocity);
    for (const Steering& s : steering) s.finish(dt);
    if (r.stop.blocks(before.position, *r.twist)) {
      *r.pose = before;
      *r.twist = {};
      for (const VehicleWheel& w : wheels) *w.velocity = 0;
      return;
    }
    for (const VehicleWheel& w : wheels) {
      *w.position += w.driven ? w.ramp.angle(dt) : w.turned;
      *w.velocity = w.driven ? w.ramp.last : w.speed_at(velocity);
    }
  }

  double max_acceleration_ = unlimited;
  std::vector<Robot> robots_;
  std::vector<VehicleWheel> wheels_;
  std::vector<Steering> steering_;
  OtherJoints others_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Ackermann>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_ackermann", .version = "1.0.0", .licence = "MIT",
            .summary = "Kinematic motion of vehicles with steered wheels", .algorithms = algorithms)
