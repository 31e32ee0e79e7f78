// SPDX-License-Identifier: MIT
// Sensors of a robot's own state in cases with known answers, for every motion that supports them.
#pragma once

#include "tests/support/bodies.hpp"

namespace muro::sensor_conformance {

inline constexpr double g = 9.81;  ///< m/s^2

/// Way in which a motion moves robots.
enum class Family : std::uint8_t {
  point,    ///< as its commands say
  wheeled,  ///< as its wheels turn
  forces,   ///< by forces
  legged,   ///< about the foot that it stands on
};
Family family_of(const std::string& motion);
/// Returns the motions of the build by id.
std::vector<std::string> motions();

/// A robot, its motion and its sensors.
class Trial : public test::Scene {
 public:
  using Parameters = std::map<std::string, ParameterInput>;
  explicit Trial(std::string motion) : motion_(std::move(motion)) {}

  Family family() const { return family_of(motion_); }
  /// Adds a vehicle that the motion can drive: one of examples/models for wheeled motions, a box of 2 kg for others. It
  /// has a turntable about z in the middle of the base, with joint `table` and link `disc`. A legged robot stands at
  /// `pose` on a plane of its own.
  const RobotView& add_vehicle(const Pose& pose = {}, const Twist& twist = {});
  /// Adds the vehicle of the motion with a link `arm` of 0.5 kg on a joint `lift` about `axis` of the base, at
  /// `position` (rad). The centre of mass of the arm is 0.3 m along x.
  const RobotView& add_arm(const Vec3& axis, double position);
  /// Adds the vehicle of the motion with a tray: a link `tray` of 0.2 kg whose upper side is 0.5 m above its base.
  const RobotView& add_carrier(const Pose& pose = {});
  /// Adds a robot `load` of another motion. Call it after the robots of the motion itself are added.
  const RobotView& add_load(const std::string& motion, const RobotTree& tree, const Pose& pose,
                            const Twist& twist = {});
  /// Adds a sensor on a link or joint of the last robot.
  ObjectId add_sensor(const std::string& id, const std::string& on, Parameters parameters = {}, double rate = 1000);
  /// Adds the motion (1000 Hz), drives and contacts, and builds. Leaves out `parameters` that the motion does not have.
  void start(Parameters parameters = {});
  /// Finds contacts also for robots that no force moves. Call it before start().
  void find_contacts() { finds_contacts_ = true; }
  /// Commands `speed` (m/s) forward and `yaw_rate` (rad/s) of robots that are not moved by forces.
  void command(double speed, double yaw_rate);
  double& joint(const std::string& name, const Key<double>& key) { return world().value("r/" + name, key); }
  Vec3 linear_acceleration(ObjectId s) const { return world().value(s, keys::linear_acceleration); }
  Vec3 angular_velocity(ObjectId s) const { return world().value(s, keys::angular_velocity); }

  /// Returns the name of the robot's base, without the robot's name.
  std::string base_name() const { return std::string(world().object_name(robot().base()).substr(2)); }
  const RobotView& robot() const { return *world().robots().front(); }

 private:
  const RobotView& add_legged(const std::string& more, const Pose& pose);

  std::string motion_, motion_of_load_;
  bool finds_contacts_ = false;
};

/// Result of a case.
struct Outcome {
  double error = 0;
  std::string seen;
};

/// Way in which a motion gives an answer.
enum class How : std::uint8_t {
  analytic,     ///< exact up to rounding
  differenced,  ///< from the difference over a step: the error falls with its length
  refused,      ///< the set-up check refuses it and gives the reason
  left_out,     ///< the case makes no sense there
};

struct Case {
  std::string_view name;    ///< a sentence
  std::string_view plugin;  ///< of the sensor
  std::string_view unit;    ///< of the error
  /// Entries for point, wheeled, forces. Legged motions are like wheeled ones, but have no cases that drive.
  How how[3] = {How::analytic, How::analytic, How::differenced};
  double bound[3] = {1e-9, 1e-9, 1e-6};
  Outcome (*run)(const std::string& motion) = nullptr;
  std::string_view only_for{};  ///< the only motion that it is for; empty: all of the family
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

/// Bound of a motion: that of the case, or its own with a reason.
struct Bound {
  double error = 0;
  std::string_view why{};
};
Bound bound_of(const std::string& motion, const Case& c);

Outcome difference(const Vec3& seen, const Vec3& expected);
Outcome difference(double seen, double expected);

}  // namespace muro::sensor_conformance
