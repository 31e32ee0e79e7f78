// SPDX-License-Identifier: MIT
// Odometry: computes the path of the base from the angles of wheels, along exact arcs.
#include <cmath>
#include <numbers>
#include <vector>

#include "motion_noise.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/link_motion/link_motion.hpp"
#include "plugins/common/wheels/omni_jacobian.hpp"
#include "plugins/common/wheels/planar_motion.hpp"
#include "plugins/common/wheels/side_wheels.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"

namespace {

using namespace muro;
using namespace muro::wheels;

constexpr std::string_view drives[] = {"differential", "omni"};
constexpr double no_errors[] = {0, 0}, no_alphas[] = {0, 0, 0, 0};
constexpr Parameter parameters[] = {
    text("drive", "differential",
         "differential: by the mean of the wheels on each side, also of a car's rear axle; omni: mecanum and omni "
         "wheels")
        .one_of(drives),
    left_wheels,
    right_wheels,
    all_wheels,
    wheel_radius,
    track,
    roller_angle,
    reals("radius_error", "1", no_errors,
          "by how much of itself the radius of the left and of the right wheels is estimated too large")
        .of_length(2),
    real("track_error", "1", 0, "by how much of itself the track is estimated too large").between(-0.9, 1e3),
    integer("counts", 0, "steps in a turn of each wheel's encoder; 0: none").between(0, 1 << 30),
    reals("alphas", "rad^2/rad, rad^2/m, m^2/m, m^2/rad", no_alphas,
          "noise: variance of the turn by the turn and by the way, of the way by the way and by the turn")
        .of_length(4)
        .between(0, 1e3),
};
constexpr PropertyUse reads[] = {{"joint.position", "of the wheels"},
                                 {"collision.shapes", "of the wheels; else visual.shapes"}};
constexpr PropertyUse writes[] = {{"odometry.pose", "of the base where the run began"},
                                  {"odometry.twist", "mean since the last reading, axes of the base"},
                                  {"odometry.wheels", "state: angles of the wheels at the last reading"}};
constexpr Key<double> wheel_angles{"odometry.wheels", "rad", "array: angles of the wheels at the last reading"};
constexpr Description description{
    .id = "sensor.odometry",
    .kind = Kind::sensor,
    .version = "1.1.0",
    .summary = "Path of the base from the angles of its wheels, along exact arcs, with systematic errors and noise",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// A wheel, and the motion of the base that is estimated from it.
struct CountedWheel {
  link_motion::JointMotion joint;
  PlanarTwist column;  ///< m, m and rad for each rad of the joint
  double start = 0;    ///< rad
};

/// Data of one vehicle.
struct Vehicle {
  Range wheels;
  std::uint64_t key = 0;  ///< key of its random numbers
  ArrayOut<double> angles;
  Out<Pose> pose;
  Out<Twist> twist;
};

class Odometry final : public PerRobotAlgorithm<Vehicle> {
 public:
  void step(const Step& step, Range range) override {
    for (const Vehicle& v : robots(range)) {
      const std::span<double> angles = *v.angles;
      PlanarTwist moved;
      std::size_t i = 0;
      for (const CountedWheel& w : wheels_[v.wheels]) {
        const double now = counted(w.joint.position());
        moved = moved + w.column * (now - (step.index == 0 ? counted(w.start) : angles[i]));
        angles[i++] = now;
      }
      moved = noise_(moved, Random(step.seed, v.key, step.index));
      *v.pose = *v.pose * arc(moved, 1);
      v.pose->orientation.normalize();
      *v.twist = {Vec3(moved.x, moved.y, 0) / step.dt, Vec3(0, 0, moved.yaw_rate) / step.dt};
    }
  }

 private:
  void read_parameters(const Parameters& p) override {
    noise_ = odometry::MotionNoise(p.reals("alphas"), p.text("drive") == "omni");
    step_ = p.integer("counts") > 0 ? 2 * std::numbers::pi / double(p.integer("counts")) : 0;
    for (const double e : p.reals("radius_error"))
      if (!(e > -1)) throw Error("radius_error is " + number_text(e) + "; a radius stays above 0: give more than -1");
  }

  Vehicle connect_robot(Connector& c, const Item& item) override {
    internal_sensor::require_rate(c);
    const RobotView& robot = *item.robot;
    std::vector<CountedWheel> wheels =
        c.parameters().text("drive") == "omni" ? omni_wheels(c, robot) : side_wheels(c, robot);
    Vehicle v;
    v.key = fnv1a(c.object_name(item.object));
    v.angles = c.variable_array(item.object, wheel_angles, std::uint32_t(wheels.size()));
    v.wheels = wheels_.add(wheels);
    v.pose = c.variable(item.object, keys::odometry_pose, Pose{});
    v.twist = c.variable(item.object, keys::odometry_twist, Twist{});
    return v;
  }

  static CountedWheel counted_wheel(Connector& c, const RobotView& robot, std::uint32_t link,
                                    const PlanarTwist& column) {
    const double start = initial_joint_positions(c, robot)[link];
    return {{c, robot, link, start, link_motion::Order::pose}, column, start};
  }

  /// Siegwart, Nourbakhsh and Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd edition, section 5.2.4.
  static std::vector<CountedWheel> side_wheels(Connector& c, const RobotView& robot) {
    const SideWheels found = find_side_wheels(c, robot);
    const std::span<const double> errors = c.parameters().reals("radius_error");
    const double estimated_track = found.track * (1 + c.parameters().real("track_error"));
    std::vector<CountedWheel> wheels;
    for (const bool is_left : {true, false}) {
      const std::vector<Wheel>& side = is_left ? found.left : found.right;
      const double yaw_rate = (is_left ? -1 : 1) / estimated_track;
      const PlanarTwist by_metre{0.5 + yaw_rate * found.middle.y(), -yaw_rate * found.middle.x(), yaw_rate};
      for (const Wheel& w : side) {
        const double radius = w.radius * (1 + errors[is_left ? 0 : 1]);
        wheels.push_back(counted_wheel(c, robot, w.link, by_metre * (w.direction * radius / double(side.size()))));
      }
    }
    return wheels;
  }

  static std::vector<CountedWheel> omni_wheels(Connector& c, const RobotView& robot) {
    for (const char* name : {"radius_error", "track_error"})
      if (c.parameters().given(name))
        throw Error(std::string(name) +
                    " is of a differential drive; with `drive: omni` give `wheel_radius` as it is "
                    "estimated");
    const std::vector<OmniWheel> found = find_omni_wheels(c, robot);
    const std::vector<PlanarTwist> columns = jacobian_columns(robot, found);
    std::vector<CountedWheel> wheels;
    for (std::size_t i = 0; i < found.size(); ++i) wheels.push_back(counted_wheel(c, robot, found[i].link, columns[i]));
    return wheels;
  }

  double counted(double angle) const { return step_ == 0 ? angle : step_ * std::floor(angle / step_ + 0.5); }

  double step_ = 0;  ///< rad, of encoders; 0: none
  odometry::MotionNoise noise_;
  PackedLists<CountedWheel> wheels_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Odometry>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_odometry", .version = description.version, .licence = "MIT",
            .summary = "Odometry of wheeled vehicles", .algorithms = algorithms)
