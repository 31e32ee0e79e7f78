// SPDX-License-Identifier: MIT
// A robot in MuJoCo: a tree of bodies in reduced coordinates. Its state is a range of qpos and qvel.
#pragma once

#include <optional>

#include "mujoco_library.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::mujoco {

/// Inertia (kg, kg m^2) added to each degree of freedom of a robot that no force moves: constraints use its velocity
/// and cannot change it.
inline constexpr double kinematic_armature = 1e15;

/// Bits of geoms: geoms that forces move touch everything; other geoms touch only those.
inline constexpr int dynamic_bit = 1, fixed_bit = 2;

/// The task of the row of a degree of freedom's drive or friction.
struct DofDrive {
  double velocity = 0;    ///< rad/s or m/s, velocity to hold
  double softness = 0;    ///< see multibody::DriveTarget
  double mimic_lead = 0;  ///< see multibody::DriveTarget
};

class MujocoRobot {
 public:
  /// Number of values that a robot keeps from step to step: accelerations from which the solver starts.
  static std::size_t memory_of(const multibody::RobotModel& model) {
    return model.bodies.size() - 1 + (model.fixed_base ? 0 : 6);
  }

  /// `exact_attitude`: see MujocoSettings.
  MujocoRobot(const multibody::RobotModel& model, multibody::RobotState& state, std::size_t owner, bool exact_attitude)
      : model_(&model),
        state_(&state),
        owner_(owner),
        rotates_exactly_(exact_attitude && model.bodies.size() == 1 && !model.fixed_base) {}

  /// Finds its bodies in the compiled model, and restores values that the compiler has changed.
  void find_indices(mjModel& m);
  /// Sets the length `dt` (s) of the next steps. Adds dt times the damping of joints to their armature, which makes the
  /// damping implicit: M a = f - B (v + a dt).
  void set_time_step(mjModel& m, double dt);
  /// Takes over state and drive targets. `drives`: one for each degree of freedom of the world.
  void import(mjModel& m, mjData& d, std::span<DofDrive> drives);
  /// Sets external forces. Call it when bodies are in their places.
  void set_forces(mjData& d);
  /// Copies the results of the step to the state.
  void export_state(const mjData& d);
  /// Sets the effort that the row of a joint's drive or friction applied.
  void set_effort(std::size_t number, double effort) { efforts_[number] = effort; }
  /// Adds a force (N) and a torque (N m) that act at `point` (m) on a body of the model.
  void add_contact(const mjData& d, std::uint32_t body, std::uint32_t loaded_link, const Vec3& force,
                   const Vec3& torque, const Vec3& point) const;

  const multibody::RobotModel& model() const { return *model_; }
  multibody::RobotState& state() const { return *state_; }
  /// Whether this degree of freedom of the world belongs to the robot.
  bool has_dof(int number) const { return number >= first_dof_ && number < first_dof_ + dof_count_; }
  std::size_t owner() const { return owner_; }
  /// Number of a body in the engine.
  int body(std::size_t number) const { return bodies_[number]; }
  int dof(std::size_t number) const { return dofs_[number]; }

 private:
  void set_motion_type(mjModel& m);
  void set_state(mjData& d) const;
  void set_joint(mjModel& m, mjData& d, std::size_t number, std::span<DofDrive> drives) const;
  void cancel_gyroscopic_torque(mjData& d) const;
  Vec3 rotated(const mjData& d, std::size_t number, const Vec3& v) const;

  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  std::size_t owner_;
  bool rotates_exactly_;
  int first_dof_ = 0, dof_count_ = 0;           ///< degrees of freedom
  int base_position_ = 0;                       ///< index in qpos of a free base
  int mocap_ = -1;                              ///< number of a fixed base
  std::vector<int> bodies_;                     ///< one per body
  std::vector<int> joints_, positions_, dofs_;  ///< one per body; none for the base
  std::vector<int> couplings_;                  ///< one per mimic joint: equality that holds it
  std::vector<double> efforts_;                 ///< one per body
  double dt_ = 0;
  std::optional<multibody::MotionType> motion_type_;  ///< type for which the model is set
  bool has_forces_ = false;                           ///< external forces are set
};

}  // namespace muro::mujoco
