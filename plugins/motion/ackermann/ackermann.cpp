// SPDX-License-Identifier: MIT
// Vehicles with steered wheels. The steering angles give the centre about which the base turns; driven wheels give the
// speed. Siegwart, Nourbakhsh and Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.
#include "muro/toolkit/contact_stop.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/wheels/motion_description.hpp"
#include "plugins/common/wheels/non_wheel_joints.hpp"
#include "plugins/common/wheels/parameters.hpp"
#include "plugins/common/wheels/terrain_travel.hpp"
#include "plugins/motion/common/motion/description.hpp"
#include "plugins/motion/common/motion/motion.hpp"
#include "steered_vehicle.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

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
    reads_initial_pose,
    reads_initial_twist,
    reads_initial_positions,
    reads_wheel_shapes,
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
                feature_joint_speed_limits | feature_mimic_joints | feature_heightmaps,
};

/// Data of a robot.
struct AckermannRobot {
  Out<Pose> pose;
  Out<Twist> twist;
  RollingConstraints constraints;
  Range wheels, steering, contacts;
  NonWheelJoints::OfRobot other_joints;
  std::string_view name;
  ContactStop stop;
};

class Ackermann final : public Motion<PerRobotAlgorithm<AckermannRobot>> {
 public:
  /// Sets wheel speeds that fit the base's velocity best; the steering continues from its present angles.
  void on_handover(std::uint32_t item) override {
    const AckermannRobot& r = robot(item);
    const std::span<SteeringJoint> steering = steering_[r.steering];
    const PlanarTwist moving = in_plane(*r.pose, *r.twist);
    for (const SteeringJoint& s : steering) *s.velocity = 0;
    for (VehicleWheel& w : wheels_[r.wheels]) {
      if (w.steering.joint >= 0) w.steer(*steering[std::size_t(w.steering.joint)].position, 0);
      *w.velocity = std::clamp(w.speed_at(moving), -w.max_speed, w.max_speed);
    }
  }

 private:
  void move(const Step& step, Range range) override {
    for (const AckermannRobot& r : robots(range)) {
      const std::span<VehicleWheel> wheels = wheels_[r.wheels];
      const std::span<SteeringJoint> steering = steering_[r.steering];
      begin_step(r, wheels, steering, step.dt);
      move_base(r, wheels, steering, step.dt);
      other_joints_.move(r.other_joints, step.dt);
    }
  }

  void read_parameters(const Parameters& p) override {
    max_acceleration_ = p.real(max_wheel_acceleration.name);
    max_steering_rate_ = p.real("max_steering_rate");
  }

  AckermannRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    const std::vector<SteeredWheel> found = find_steered_wheels(c, robot);
    const SteeringGeometry geometry = steering_geometry(robot.links, found);
    Pose start = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist moving = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    const std::vector<double> positions = initial_joint_positions(c, robot);
    JointState state(robot);

    const std::vector<PlanarWheel> planes(found.begin(), found.end());
    const Range contacts =
        terrain_.connect(c, robot, std::vector<StandingWheel>(found.begin(), found.end()), positions);
    std::vector<VehicleWheel> wheels;
    std::vector<SteeringJoint> steering;
    for (const std::size_t link : geometry.joints)
      steering.push_back(connect_steering(c, robot.links[link], positions[link]));
    for (std::size_t k = 0; k < found.size(); ++k) {
      VehicleWheel w{.plane = planes[k], .steering = geometry.wheels[k], .is_driven = found[k].driven};
      w.max_speed = w.is_driven ? found[k].limits.velocity : std::numeric_limits<double>::infinity();
      w.steer(w.steering.joint >= 0 ? positions[geometry.joints[std::size_t(w.steering.joint)]] : 0, 0);
      const double speed = std::clamp(w.speed_at(in_plane(start, moving)), -w.max_speed, w.max_speed);
      w.state.speed = speed / w.plane.angle_per_metre;
      const ObjectId joint = robot.links[found[k].link].joint_object;
      if (w.is_driven) w.target = c.input(joint, keys::joint_velocity_target, 0.0);
      w.position = c.variable(joint, keys::joint_position, positions[found[k].link]);
      w.velocity = c.variable(joint, keys::joint_velocity, speed);
      wheels.push_back(w);
    }
    const RollingConstraints constraints(planes);
    const PlanarTwist velocity = SteeredVehicle(constraints, wheels, steering).motion().velocity;
    place_contacts(contacts, wheels);
    terrain_.settle(contacts, start, start);
    AckermannRobot r{
        c.variable(robot.base(), keys::pose, start), {}, constraints, {}, {}, contacts, {}, robot.name, {}};
    r.twist = c.variable(robot.base(), keys::twist, terrain_.in_world(contacts, start, velocity));
    for (std::size_t k = 0; k < steering.size(); ++k) state.bind(geometry.joints[k], steering[k]);
    for (std::size_t k = 0; k < found.size(); ++k) state.bind(found[k].link, wheels[k]);
    r.wheels = wheels_.add(wheels);
    r.steering = steering_.add(steering);
    r.other_joints = other_joints_.connect(c, robot, positions, state);
    r.stop = ContactStop(c, robot, terrain_.ground());
    return r;
  }

  SteeringJoint connect_steering(Connector& c, const Link& link, double position) const {
    SteeringJoint s;
    s.position = c.variable(link.joint_object, keys::joint_position, position);
    s.velocity = c.variable(link.joint_object, keys::joint_velocity, 0.0);
    check_start(c, link.joint_object, link.limits, position);
    s.target = c.input(link.joint_object, keys::joint_position_target, position);
    s.limits = link.limits;
    s.max_rate = std::min(link.limits.velocity, max_steering_rate_);
    return s;
  }

  /// Reads the targets of wheels and steering, and plans how this step approaches them.
  void begin_step(const AckermannRobot& r, std::span<VehicleWheel> wheels, std::span<SteeringJoint> steering,
                  double dt) const {
    double sum = 0;
    for (SteeringJoint& s : steering) s.begin(dt), sum += s.final;
    for (VehicleWheel& w : wheels) {
      if (!w.is_driven) continue;
      w.ramp = velocity_ramp(*w.velocity, std::clamp(*w.target, -w.max_speed, w.max_speed), max_acceleration_, dt);
      sum += w.ramp.final;
    }
    if (!(std::abs(sum) < fastest))
      throw Error("a joint of `" + std::string(r.name) +
                  "` is to turn at a speed or to an angle that is not finite, or beyond 1e12; look at what writes "
                  "`joint.velocity.target` and `joint.position.target`");
  }

  /// A wheel; the ground is checked below its centre.
  struct StandingWheel {
    std::uint32_t link;
    Vec3 lowest;
    double radius;
    explicit StandingWheel(const SteeredWheel& w) : link(w.link), lowest(lowest_point(w)), radius(w.radius) {}
  };

  /// Places the contact points of a robot below its wheels at their present steering angles.
  void place_contacts(Range contacts, std::span<const VehicleWheel> wheels) {
    if (!terrain_.follows()) return;
    const std::span<ground::ContactPoint> points = terrain_.contacts_of(contacts);
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      const PlanarWheel& w = wheels[i].plane;
      const WheelState& s = wheels[i].state;
      points[i].at.x() = w.x + s.cosine * w.forward_offset - s.sine * w.left_offset;
      points[i].at.y() = w.y + s.sine * w.forward_offset + s.cosine * w.left_offset;
    }
  }

  /// m/s: upper bound of the rolling speeds of driven wheels in this step.
  static double fastest_along(std::span<const VehicleWheel> wheels) {
    double speed = 0;
    for (const VehicleWheel& w : wheels)
      if (w.is_driven)
        speed = std::max(
            speed, std::max(std::abs(w.ramp.initial), std::abs(w.ramp.final)) / std::abs(w.plane.angle_per_metre));
    return speed;
  }

  void move_base(const AckermannRobot& r, std::span<VehicleWheel> wheels, std::span<SteeringJoint> steering,
                 double dt) {
    const Pose before = *r.pose;
    const double longest = terrain_.follows() ? terrain_.longest_interval(fastest_along(wheels), dt) : dt;
    const PlanarTwist velocity =
        SteeredVehicle(r.constraints, wheels, steering)
            .move(*r.pose, r.twist->angular.norm(), dt, longest, [&](const Pose& from, Pose& pose) {
              place_contacts(r.contacts, wheels);
              terrain_.settle(r.contacts, from, pose);
            });
    r.pose->orientation.normalize();
    *r.twist = terrain_.in_world(r.contacts, *r.pose, velocity);
    for (const SteeringJoint& s : steering) s.finish(dt);
    if (r.stop.blocks(before.position, *r.twist)) {
      *r.pose = before;
      *r.twist = {};
      for (const VehicleWheel& w : wheels) *w.velocity = 0;
      return;
    }
    for (const VehicleWheel& w : wheels) {
      *w.position += w.is_driven ? w.ramp.angle(dt) : w.rolled_angle;
      *w.velocity = w.is_driven ? w.ramp.final : w.speed_at(velocity);
    }
  }

  double max_acceleration_ = unlimited;
  double max_steering_rate_ = unlimited;
  TerrainTravel terrain_;
  PackedLists<VehicleWheel> wheels_;
  PackedLists<SteeringJoint> steering_;
  NonWheelJoints other_joints_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Ackermann>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_ackermann", .version = description.version, .licence = "MIT",
            .summary = "Kinematic motion of vehicles with steered wheels", .algorithms = algorithms)
