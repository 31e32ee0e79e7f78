// SPDX-License-Identifier: MIT
// A robot of an MJCF file in MuJoCo, with the file's own joints, actuators and parameters.
#pragma once

#include <optional>

#include "model_source.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::mujoco {

class ModelRobot {
 public:
  /// Number of values that it keeps from step to step: the accelerations from which the solver starts, the activations
  /// of actuators, and the exact spin of a free base in its own axes.
  static std::size_t memory_of(const multibody::RobotModel& model, const ModelRobotSource& source) {
    return model.bodies.size() - 1 + (source.is_free ? 6 + 3 : 0) + source.activations.size();
  }

  ModelRobot(const multibody::RobotModel& model, multibody::RobotState& state, const ModelRobotSource& source);

  /// Finds its joints in the compiled model, in which the numbers of the source are valid.
  void find_indices(mjModel& m);
  /// Takes over state, targets and external forces.
  void import(mjModel& m, mjData& d);
  /// Copies the results of the step to the state.
  void export_state(const mjData& d);
  /// Adds the force (N) and torque (N m) of a contact at `point` (m) on one of its bodies in MuJoCo.
  void add_contact(const mjData& d, int body, const Vec3& force, const Vec3& torque, const Vec3& point) const;
  /// Adds an overlap of one of its bodies with scenery.
  void add_overlap(int body, double depth, const std::string& obstacle);

  multibody::RobotState& state() const { return *state_; }
  /// Returns the object in muro that belongs to a body in MuJoCo.
  ObjectId object_of(int body) const {
    const std::int32_t link = loaded_links_[std::size_t(body)];
    return link < 0 ? no_object : model_->loaded_links[std::size_t(link)].object;
  }
  int root() const { return source_->root; }

 private:
  struct Joint {
    int joint = -1, position = 0, dof = 0;
    bool has_body = false;  ///< its link is a body of the file; else it is at the anchor of the joint
  };

  void set_motion_type(mjModel& m);
  void set_base(mjModel& m, mjData& d) const;
  void set_forces(const mjModel& m, mjData& d);
  void set_controls(const mjModel& m, mjData& d) const;
  void set_drive_losses(mjModel& m) const;
  std::span<double> kept_spin() const;
  Vec3 origin_of(const mjData& d, std::uint32_t body) const;

  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  const ModelRobotSource* source_;
  std::vector<Joint> joints_;               ///< one per body of the model; unused for the base
  std::vector<std::int32_t> loaded_links_;  ///< number for each body in MuJoCo; -1: none
  int first_dof_ = 0, dof_count_ = 0, free_position_ = 0;
  Pose root_pose_;                                          ///< pose in the file of a root that the world holds
  std::vector<double> armatures_, friction_losses_;         ///< from the file, one per degree of freedom of the robot
  std::vector<std::pair<int, std::pair<int, int>>> geoms_;  ///< with contype and conaffinity of the file
  std::optional<multibody::MotionType> motion_type_;        ///< type for which the model is set
  bool has_forces_ = false;                                 ///< external forces are set
  std::vector<multibody::BodyState> body_states_;           ///< scratch
};

}  // namespace muro::mujoco
