// SPDX-License-Identifier: MIT
// A robot in ODE: a body a part, a hinge or slider a joint.
#pragma once

#include <deque>

#include "geoms.hpp"

namespace muro::ode {

class Robot {
 public:
  /// How many numbers a robot keeps from step to step: places and velocities of its bodies.
  static std::size_t memory_of(const multibody::RobotModel& model) { return numbers * model.parts.size(); }

  /// `space`: for its geoms. `owners`: those of all geoms of the world, to which it adds its own.
  Robot(dWorldID world, dSpaceID space, const multibody::RobotModel& model, multibody::RobotState& state,
        std::int32_t number, std::deque<Owner>& owners, const Meshes& meshes, bool reactions);

  /// Places bodies and sets forces and drives for a step.
  void import();
  /// Takes over what the step made of it.
  void export_state(double dt);
  /// Adds what a contact did to the body that `owner` names: force (N) and torque (N m) about its centre of mass.
  void add_contact(const Owner& owner, const Vec3& force, const Vec3& torque);

  const multibody::RobotModel& model() const { return *model_; }
  multibody::Presence presence() const { return presence_; }
  dSpaceID space() const { return space_; }
  const std::vector<dGeomID>& geoms() const { return geoms_; }

 private:
  static constexpr std::size_t numbers = 13;  ///< of a body: position, orientation, velocity, spin

  struct Body {
    dBodyID id = nullptr;
    Vec3 com = Vec3::Zero();     ///< in the frame of the part
    dJointID joint = nullptr;    ///< that moves it; none for the base
    dJointID drive = nullptr;    ///< of a joint with stops; none: `joint` drives itself
    dJointID damper = nullptr;   ///< none where the model has no damping
    double speed = 0, most = 0;  ///< what the drive was told last
    bool turns_alone = false;    ///< it turns, and carries nothing that shifts: its place is not asked for
    bool far_stops = false;      ///< see set_near_stops
    dJointFeedback feedback{};   ///< of what drives the joint
  };

  void add_body(std::size_t part);
  void add_joint(std::size_t part);
  dJointID make_motor(std::size_t part, const Vec3& axis) const;
  void set_presence(multibody::Presence presence);
  void place_by_parts();
  void place_from_memory();
  void set_forces();
  void set_drive(std::size_t part);
  static void set_stops(const Body& body, JointKind kind, double low, double high);
  void set_near_stops(std::size_t part) const;
  multibody::PartMotion motion_of(std::size_t part) const;
  void export_joint(std::size_t part, double dt);

  dWorldID world_;
  dSpaceID space_;
  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  bool reactions_;  ///< whether efforts of drives are found out
  multibody::Presence presence_ = multibody::Presence::simulated;
  std::deque<Body> bodies_;  ///< one a part
  bool in_place_ = false;    ///< they are where the memory says
  std::vector<dGeomID> geoms_;
  std::vector<multibody::PartMotion> parts_;
};

}  // namespace muro::ode
