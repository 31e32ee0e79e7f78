// SPDX-License-Identifier: MIT
// The point model (MuRoSimF, Section 3.2): the base moves as commanded, and joints follow their targets.
#include <string>

#include "muro/plugin.hpp"
#include "muro/toolkit/contact_stop.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/wheels/terrain.hpp"
#include "plugins/common/wheels/wheel_finder.hpp"
#include "plugins/motion/common/kinematic_joints/kinematic_joints.hpp"
#include "plugins/motion/common/motion/description.hpp"
#include "plugins/motion/common/motion/motion.hpp"

namespace {

using namespace muro;

constexpr std::string_view modes[] = {"velocity", "pose"};
constexpr std::string_view joint_modes[] = {"auto", "velocity", "position", "passive"};
constexpr Parameter parameters[] = {
    text("mode", "velocity", "follow command.twist, or go to command.pose").one_of(modes),
    real("max_speed", "m/s", 1e9, "largest linear speed").between(0, 1e9),
    real("max_turn_rate", "rad/s", 1e9, "largest angular speed").between(0, 1e9),
    real("max_acceleration", "m/s^2", 1e9, "largest change of the linear velocity").between(0, 1e9),
    real("max_turn_acceleration", "rad/s^2", 1e9, "largest change of the angular velocity").between(0, 1e9),
    real(
        "height_above_ground", "m", -1,
        "terrain following: the height that the base keeps above the heightmaps and planes of the scenery, whatever is "
        "commanded; -1: none, it moves as commanded")
        .between(-1, 1e6),
    on_contact,
    text("joints", "auto",
         "which target joints follow; auto: of position where something writes it, else of velocity, and wheels stand "
         "still; passive: none, control code may write `joint.position` itself")
        .one_of(joint_modes),
};
constexpr PropertyUse own_reads[] = {{"command.twist", "mode velocity"},
                                     {"command.pose", "mode pose"},
                                     {"joint.position.target", "of joints that follow it"},
                                     {"joint.velocity.target", "of joints that follow it"},
                                     on_contact_reads};
constexpr auto reads = joined(own_reads, reads_start);
constexpr Description description{
    .id = "motion.point",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Moves the base as commanded and joints to their targets, within limits; no forces, no contact",
    .parameters = parameters,
    .reads = reads,
    .writes = motion_writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_position_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_mimic_joints | feature_heightmaps,
};

Vec3 limited(const Vec3& v, double max_length) {
  const double length = v.norm();
  return length > max_length ? Vec3(v * (max_length / length)) : v;
}

/// Returns `from` moved towards `to` by at most `max_change`.
Vec3 approached(const Vec3& from, const Vec3& to, double max_change) { return from + limited(to - from, max_change); }

/// Returns the velocity that covers `distance` in one step, or the largest one from which the deceleration
/// `max_acceleration` still stops in time.
Vec3 approach_velocity(const Vec3& distance, double max_acceleration, double dt) {
  const double length = distance.norm();
  if (length <= max_acceleration * dt * dt) return distance / dt;
  // v dt + v^2 / (2 a) = length
  return distance * (2 / (dt + std::sqrt(dt * dt + 2 * length / max_acceleration)));
}

/// Finds the links that are wheels: they turn without limits, carry no other joint and have a round shape about the
/// axis.
std::vector<bool> wheels_of(const Connector& c, const RobotView& robot) {
  const wheels::WheelFinder finder(c, robot);
  std::vector<bool> carries(robot.links.size()), are_wheels(carries);
  std::string why;
  for (std::size_t i = robot.links.size(); i-- > 1;) {
    const bool moves = robot.links[i].joint != JointKind::fixed;
    are_wheels[i] = !carries[i] && finder.turns_freely(i, why) && finder.wheel(i).radius > 0;
    if (moves || carries[i]) carries[std::size_t(robot.links[i].parent)] = true;
  }
  return are_wheels;
}

/// Data of a robot.
struct PointRobot {
  Out<Pose> pose;
  Out<Twist> twist;
  In<Twist> command_twist;
  In<Pose> command_pose;
  std::string_view name;
  ContactStop stop;
  KinematicJoints joints;
};

class Point final : public Motion<PerRobotAlgorithm<PointRobot>> {
  void bind_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < c.items().size(); ++i) robot(i).joints.follow_what_is_written(c);
  }

  void move(const Step& step, Range range) override {
    for (const PointRobot& r : robots(range)) {
      move_base(r, step.dt);
      r.joints.move(step.dt);
    }
  }

  void read_parameters(const Parameters& p) override {
    follow_pose_ = p.text("mode") == "pose";
    max_speed_ = p.real("max_speed");
    max_turn_rate_ = p.real("max_turn_rate");
    max_acceleration_ = p.real("max_acceleration");
    max_turn_acceleration_ = p.real("max_turn_acceleration");
    height_ = p.real("height_above_ground");
  }

  PointRobot connect_robot(Connector& c, const Item& item) override {
    const ObjectId base = item.robot->base();
    Pose start = c.constant(base, keys::initial_pose).value_or(Pose{});
    if (follows_terrain()) {
      terrain_.connect(c);
      Twist unused;
      follow_terrain(start.position.z(), start, unused);
    }
    PointRobot r;
    r.name = item.robot->name;
    r.pose = c.variable(base, keys::pose, start);
    r.twist = c.variable(base, keys::twist, c.constant(base, keys::initial_twist).value_or(Twist{}));
    if (follow_pose_)
      r.command_pose = c.input(base, keys::command_pose, start);
    else
      r.command_twist = c.input(base, keys::command_twist, Twist{});
    r.stop = ContactStop(c, *item.robot, terrain_.shapes());
    const std::string_view mode = c.parameters().text("joints");
    if (mode == "auto")
      r.joints = KinematicJoints(c, *item.robot, {}, wheels_of(c, *item.robot));
    else if (mode != "passive")
      r.joints = KinematicJoints(c, *item.robot, std::vector(item.robot->links.size(), drive_mode_of(mode)));
    return r;
  }

  /// Returns the velocity (world axes) that would fulfil the command within this step.
  Twist commanded_velocity(const PointRobot& r, double dt) const {
    const Pose& pose = *r.pose;
    if (!follow_pose_) return {pose.orientation * r.command_twist->linear, pose.orientation * r.command_twist->angular};
    const Vec3 turn = rotation_vector_of(r.command_pose->orientation * pose.orientation.conjugate());
    return {approach_velocity(r.command_pose->position - pose.position, max_acceleration_, dt),
            approach_velocity(turn, max_turn_acceleration_, dt)};
  }

  bool follows_terrain() const { return height_ >= 0; }

  /// Sets the base to its height above the ground, or to `height` (m) when there is no ground. Makes `v` (world axes)
  /// follow the slope.
  void follow_terrain(double height, Pose& pose, Twist& v) const {
    pose.position.z() = height;
    if (!pose.position.allFinite()) return;
    const auto ground = terrain_.ground_at(pose.position.x(), pose.position.y());
    if (!ground) return;
    pose.position.z() = ground->height + height_;
    v.linear.z() = ground->slope_x * v.linear.x() + ground->slope_y * v.linear.y();
  }

  void move_base(const PointRobot& r, double dt) const {
    Twist goal = commanded_velocity(r, dt);
    Twist& v = *r.twist;
    if (follows_terrain()) goal.linear.z() = v.linear.z() = 0;
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
    const double height = pose.position.z();
    if (follow_pose_) {  // straight to the goal, turning on the way
      pose.position += v.linear * dt;
    } else {  // the velocity is constant in the axes of the base, which turn: the path is a screw
      pose.position += screw_integral(angle) * v.linear * dt;
      v.linear = turn * v.linear;
    }
    pose.orientation = (turn * pose.orientation).normalized();
    if (follows_terrain()) follow_terrain(height, pose, v);
  }

  ground::Terrain terrain_;
  double height_ = -1;  ///< m; below 0: it ignores terrain
  bool follow_pose_ = false;
  double max_speed_ = 0, max_turn_rate_ = 0, max_acceleration_ = 0, max_turn_acceleration_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Point>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_point", .version = description.version, .licence = "MIT",
            .summary = "The point motion model", .algorithms = algorithms)
