// SPDX-License-Identifier: MIT
// The point model (MuRoSimF, Section 3.2): only the motion of the base, as commanded.
#include <string>
#include <vector>

#include "muro/plugin.hpp"
#include "muro/toolkit/contact_stop.hpp"

namespace {

using namespace muro;

constexpr std::string_view modes[] = {"velocity", "pose"};
constexpr Parameter parameters[] = {
    text("mode", "velocity", "follow command.twist, or go to command.pose").one_of(modes),
    real("max_speed", "m/s", 1e9, "largest linear speed").between(0, 1e9),
    real("max_turn_rate", "rad/s", 1e9, "largest angular speed").between(0, 1e9),
    real("max_acceleration", "m/s^2", 1e9, "largest change of the linear velocity").between(0, 1e9),
    real("max_turn_acceleration", "rad/s^2", 1e9, "largest change of the angular velocity").between(0, 1e9),
    on_contact,
};
constexpr PropertyUse reads[] = {{"command.twist", "mode velocity"},
                                 {"command.pose", "mode pose"},
                                 {"pose.initial", "of the base"},
                                 {"twist.initial", "of the base"},
                                 on_contact_reads};
constexpr PropertyUse writes[] = {{"pose", "of the base"}, {"twist", "of the base"}};
constexpr Description description{
    .id = "motion.point",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base as commanded, within limits of speed and acceleration; no forces, no contact",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

Vec3 limited(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3(v * (most / length)) : v;
}

/// `from` moved towards `to` by at most `most`.
Vec3 approached(const Vec3& from, const Vec3& to, double most) { return from + limited(to - from, most); }

class Point final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    follow_pose_ = p.text("mode") == "pose";
    max_speed_ = p.real("max_speed");
    max_turn_rate_ = p.real("max_turn_rate");
    max_acceleration_ = p.real("max_acceleration");
    max_turn_acceleration_ = p.real("max_turn_acceleration");
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it moves robots, but no robot is named");
      const ObjectId base = item.robot->base();
      const Pose start = c.constant(base, keys::initial_pose).value_or(Pose{});
      Robot r;
      r.name = item.robot->name;
      r.pose = c.variable(base, keys::pose, start);
      r.twist = c.variable(base, keys::twist, c.constant(base, keys::initial_twist).value_or(Twist{}));
      if (follow_pose_)
        r.command_pose = c.input(base, keys::command_pose, start);
      else
        r.command_twist = c.input(base, keys::command_twist, Twist{});
      r.stop = ContactStop(c, *item.robot);
      robots_.push_back(r);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) move(robots_[i], step.dt);
  }

 private:
  struct Robot {
    Out<Pose> pose;
    Out<Twist> twist;
    In<Twist> command_twist;
    In<Pose> command_pose;
    std::string_view name;
    ContactStop stop;
  };

  /// The velocity (world axes) that would fulfil the command within this step.
  Twist wanted(const Robot& r, double dt) const {
    const Pose& pose = *r.pose;
    if (!follow_pose_) return {pose.orientation * r.command_twist->linear, pose.orientation * r.command_twist->angular};
    const Eigen::AngleAxisd turn(r.command_pose->orientation * pose.orientation.conjugate());
    return {braked(r.command_pose->position - pose.position, max_acceleration_, dt),
            braked(turn.angle() * turn.axis(), max_turn_acceleration_, dt)};
  }

  /// The velocity that covers `distance` in one step, or from which the deceleration `most` still stops in time.
  static Vec3 braked(const Vec3& distance, double most, double dt) {
    const double length = distance.norm();
    if (length <= most * dt * dt) return distance / dt;
    // v dt + v^2 / (2 most) = length
    return distance * (2 / (dt + std::sqrt(dt * dt + 2 * length / most)));
  }

  void move(const Robot& r, double dt) const {
    const Twist goal = wanted(r, dt);
    Twist& v = *r.twist;
    v.linear = approached(v.linear, limited(goal.linear, max_speed_), max_acceleration_ * dt);
    v.angular = approached(v.angular, limited(goal.angular, max_turn_rate_), max_turn_acceleration_ * dt);
    if (!std::isfinite(v.linear.sum() + v.angular.sum()))
      throw Error("the command of `" + std::string(r.name) + "` is not finite; look at what writes `command." +
                  (follow_pose_ ? "pose`" : "twist`"));
    Pose& pose = *r.pose;
    if (r.stop.blocks(pose.position, v)) {
      v = {};
      return;
    }
    const Vec3 angle = v.angular * dt;
    const Quat turn = rotation_of(angle);
    if (follow_pose_) {  // straight to the goal, turning on the way
      pose.position += v.linear * dt;
    } else {  // the velocity is constant in the axes of the base, which turn: the path is a screw
      pose.position += screw_integral(angle) * v.linear * dt;
      v.linear = turn * v.linear;
    }
    pose.orientation = (turn * pose.orientation).normalized();
  }

  std::vector<Robot> robots_;
  bool follow_pose_ = false;
  double max_speed_ = 0, max_turn_rate_ = 0, max_acceleration_ = 0, max_turn_acceleration_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Point>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_point", .version = "1.0.0", .licence = "MIT", .summary = "The point motion model",
            .algorithms = algorithms)
