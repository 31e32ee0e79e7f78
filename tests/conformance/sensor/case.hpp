// SPDX-License-Identifier: MIT
// Known answers of the sensors of a robot's own state, asked of every motion that can give them.
#pragma once

#include "tests/support/bodies.hpp"

namespace muro::sensor_conformance {

inline constexpr double g = 9.81;  ///< m/s^2

/// How a motion moves robots.
enum class Family : std::uint8_t {
  point,    ///< as commanded
  wheeled,  ///< as its wheels turn
  forces,   ///< by forces
  legged,   ///< about the foot on which it stands
};
Family family_of(const std::string& motion);
/// Motions that the build offers, by id.
std::vector<std::string> motions();

/// A robot, its motion and its sensors.
class Trial : public test::Scene {
 public:
  using Parameters = std::map<std::string, ParameterInput>;
  explicit Trial(std::string motion) : motion_(std::move(motion)) {}

  Family family() const { return family_of(motion_); }
  /// A vehicle that the motion can drive: of examples/models for wheeled ones, a box of 2 kg for others. With a
  /// turntable about z, its joint `table` and its link `disc`, in the middle of the base. What is legged stands at
  /// `pose` on a plane of its own.
  const RobotView& add_vehicle(const Pose& pose = {}, const Twist& twist = {});
  /// A link `arm` of 0.5 kg whose centre of mass is 0.3 m along x, on a joint `lift` about `axis` of the base, at
  /// `position` (rad): on the vehicle of the motion.
  const RobotView& add_arm(const Vec3& axis, double position);
  /// The vehicle of the motion with a tray: a link `tray` of 0.2 kg whose upper side is 0.5 m above its base.
  const RobotView& add_carrier(const Pose& pose = {});
  /// A robot `load` of another motion; after those of the motion itself.
  const RobotView& add_load(const std::string& motion, const RobotTree& tree, const Pose& pose,
                            const Twist& twist = {});
  /// A sensor on a link or joint of the last robot.
  ObjectId add_sensor(const std::string& id, const std::string& on, Parameters parameters = {}, double rate = 1000);
  /// Adds the motion (1000 Hz), drives and contacts, and builds. `parameters` that the motion has not are left out.
  void start(Parameters parameters = {});
  /// Contacts are also found for robots that no force moves. Before start().
  void find_contacts() { finds_contacts_ = true; }
  /// Goes forward at `speed` (m/s) and turns at `yaw_rate` (rad/s): commands those that are not moved by forces.
  void command(double speed, double yaw_rate);
  double& joint(const std::string& name, const Key<double>& key) { return world().value("r/" + name, key); }
  Vec3 linear_acceleration(ObjectId s) const { return world().value(s, keys::linear_acceleration); }
  Vec3 angular_velocity(ObjectId s) const { return world().value(s, keys::angular_velocity); }

  /// The part of the robot that is its base.
  std::string base_name() const { return std::string(world().object_name(robot().base()).substr(2)); }
  const RobotView& robot() const { return *world().robots().front(); }

 private:
  const RobotView& add_legged(const std::string& more, const Pose& pose);

  std::string motion_, motion_of_load_;
  bool finds_contacts_ = false;
};

/// What a case found.
struct Outcome {
  double error = 0;
  std::string seen;
};

/// How a motion comes to an answer.
enum class How : std::uint8_t {
  analytic,     ///< exact up to rounding
  differenced,  ///< by the difference over a step: the error falls with its length
  refused,      ///< the set-up check says that it cannot, and why
  left_out,     ///< the question makes no sense there
};

struct Case {
  std::string_view name;    ///< a sentence
  std::string_view plugin;  ///< of the sensor
  std::string_view unit;    ///< of the error
  /// By family: point, wheeled, forces. What is legged is as what is wheeled, but that it does not drive.
  How how[3] = {How::analytic, How::analytic, How::differenced};
  double bound[3] = {1e-9, 1e-9, 1e-6};
  Outcome (*run)(const std::string& motion) = nullptr;
  std::string_view only_for{};  ///< the motion that it is for; empty: all of the family
};
How how(const std::string& motion, const Case& c);

std::vector<Case> all_cases();
std::vector<Case> inertial_cases();
std::vector<Case> change_cases();
std::vector<Case> wrench_cases();
std::vector<Case> touch_cases();
std::vector<Case> pair_cases();
std::vector<Case> joint_cases();
std::vector<Case> place_cases();

/// The bound of a motion, its own where it has one with a reason.
struct Bound {
  double error = 0;
  std::string_view why{};
};
Bound bound_of(const std::string& motion, const Case& c);

Outcome difference(const Vec3& seen, const Vec3& expected);
Outcome difference(double seen, double expected);

}  // namespace muro::sensor_conformance
