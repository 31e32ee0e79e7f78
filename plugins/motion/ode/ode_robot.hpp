// SPDX-License-Identifier: MIT
// A robot in ODE: one body for each rigid body, one hinge or slider for each joint.
#pragma once

#include <deque>

#include "contact_history.hpp"
#include "ode_settings.hpp"

namespace muro::ode {

class OdeRobot {
 public:
  /// Number of values that a robot keeps from step to step: poses and velocities of its bodies, its contacts and, with
  /// iterations, speeds of its rotors.
  static std::size_t memory_of(const multibody::RobotModel& model, bool exact);

  /// `space`: space for its geoms. `owners`: owners of all geoms of the world; the robot adds its own.
  OdeRobot(dWorldID world, dSpaceID space, const multibody::RobotModel& model, multibody::RobotState& state,
           std::int32_t number, std::deque<GeomOwner>& owners, const OdeMeshes& meshes, const OdeSettings& settings);
  /// Sets the length `dt` (s) of the next steps: see OdeSettings::softness.
  void set_step(double dt);

  /// Places bodies and sets forces and drives for a step.
  void import();
  /// Takes over the results of the step.
  void export_state(double dt);
  /// Adds force (N) and torque (N m, about the centre of mass) of a contact to the body that `owner` names.
  void add_contact(const GeomOwner& owner, const Vec3& force, const Vec3& torque);

  const multibody::RobotModel& model() const { return *model_; }
  multibody::RobotState& state() const { return *state_; }
  multibody::MotionType motion_type() const { return motion_type_; }
  /// 1/kg: inverse effective mass of a contact at `point` with `normal` (unit), as if no joint held the body; world
  /// axes.
  double inverse_effective_mass(std::size_t body, const Vec3& point, const Vec3& normal) const;
  /// m/s^2: acceleration of the body's centre of mass by gravity and external forces, without joints and contacts.
  Vec3 free_acceleration(std::size_t body) const;
  /// Whether cylinders or meshes of it turn without limits, and no joint is prismatic.
  bool has_wheels() const { return has_wheels_; }
  std::size_t body_count() const { return bodies_.size(); }
  dBodyID body_id(std::size_t body) const { return bodies_[body].id; }
  ContactHistory& history() { return history_; }
  dSpaceID space() const { return space_; }
  const std::vector<dGeomID>& geoms() const { return geoms_; }

 private:
  static constexpr std::size_t numbers = 13;  ///< values of a body: position, orientation, velocity, spin

  struct OdeBody {
    dBodyID id = nullptr;
    Vec3 com = Vec3::Zero();                                      ///< in the frame of the body
    Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();  ///< about the centre of mass, axes of the body
    dJointID joint = nullptr;                                     ///< joint that moves it; none for the base
    dJointID drive = nullptr;                      ///< motor of a joint with stops; none: `joint` drives itself
    dJointID damper = nullptr;                     ///< none when there is neither damping nor a rotor
    double armature = 0;                           ///< kg m^2 or kg: last value set in the damper
    double damper_speed = 0, damper_cfm = 0;       ///< last values set in the damper
    dJointFeedback of_damper{};                    ///< when the speed of a rotor is kept
    double velocity = 0, max_effort = 0, cfm = 0;  ///< last values set in the drive
    double least_cfm = 0;                          ///< softness of the joint: see OdeSettings::softness
    Quat start = Quat::Identity();                 ///< orientation at the start of the step
    bool only_rotates = false;                     ///< on a hinge, and carries no slider: its position is not needed
    bool has_far_stops = false;                    ///< see set_near_stops
    dJointFeedback feedback{};                     ///< force and torque of the drive
  };

  static bool keeps_rotors(const multibody::RobotModel& model, bool exact);
  void add_body(std::size_t body);
  void add_joint(std::size_t body);
  std::vector<double> inverse_joint_inertias() const;
  dJointID create_motor(std::size_t body, const Vec3& axis) const;
  void set_motion_type(multibody::MotionType motion_type);
  void set_bodies_from_state();
  void set_bodies_from_memory();
  void set_forces();
  void set_drive_target(std::size_t body);
  void set_rotor(std::size_t body, double armature);
  double& rotor_speed(std::size_t body) const;
  double speed_of_rotor(std::size_t body) const;
  static void set_stops(const OdeBody& body, JointKind kind, double low, double high);
  void set_near_stops(std::size_t body) const;
  multibody::BodyState body_state_of(std::size_t body) const;
  void export_joint(std::size_t body, double dt);
  void rotate_exactly(double dt);

  dWorldID world_;
  dSpaceID space_;
  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  OdeSettings settings_;
  double dt_ = 0;                 ///< s, length of a step
  bool rotates_exactly_ = false;  ///< see OdeSettings::exact_attitude
  bool keeps_rotors_ = false;     ///< speeds of rotors are in the memory
  bool has_wheels_ = false;
  multibody::MotionType motion_type_ = multibody::MotionType::dynamic;
  std::deque<OdeBody> bodies_;        ///< one per body
  bool bodies_match_memory_ = false;  ///< bodies have the state of the memory
  ContactHistory history_;
  std::vector<dGeomID> geoms_;
  std::vector<multibody::BodyState> body_states_;
};

}  // namespace muro::ode
