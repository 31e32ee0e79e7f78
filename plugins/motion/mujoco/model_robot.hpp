// SPDX-License-Identifier: MIT
// A robot of an MJCF file in MuJoCo, with the file's own joints, actuators and parameters.
#pragma once

#include <optional>

#include "model_source.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::mujoco {

class ModelRobot {
 public:
  /// How many numbers it keeps from step to step: the accelerations from which the solver starts, what actuators
  /// remember, and the spin of a free base in its own axes, to the last digit.
  static std::size_t memory_of(const multibody::RobotModel& model, const ModelRobotSource& source) {
    return model.bodies.size() - 1 + (source.is_free ? 6 + 3 : 0) + source.activations.size();
  }

  ModelRobot(const multibody::RobotModel& model, multibody::RobotState& state, const ModelRobotSource& source);

  /// Finds its joints in the compiled model. `file`: with the numbers of the source.
  void find_indices(mjModel& m);
  /// Takes over state, targets, and forces from outside.
  void import(mjModel& m, mjData& d);
  /// Hands back what the step made of it.
  void export_state(const mjData& d);
  /// Adds what a contact did to one of its bodies in MuJoCo: a force (N) and a torque (N m) at `point` (m).
  void add_contact(const mjData& d, int body, const Vec3& force, const Vec3& torque, const Vec3& point) const;
  /// How deep one of its bodies is in scenery.
  void add_overlap(int body, double depth, const std::string& obstacle);

  multibody::RobotState& state() const { return *state_; }
  /// What muro has in place of a body in MuJoCo.
  ObjectId object_of(int body) const {
    const std::int32_t link = loaded_links_[std::size_t(body)];
    return link < 0 ? no_object : model_->loaded_links[std::size_t(link)].object;
  }
  int root() const { return source_->root; }

 private:
  struct Joint {
    int joint = -1, position = 0, dof = 0;
    bool has_body = false;  ///< its link is a body of the file, else it lies at the anchor of the joint
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
  std::vector<Joint> joints_;               ///< one per body of the model; the base's is none
  std::vector<std::int32_t> loaded_links_;  ///< of each body in MuJoCo; -1
  int first_dof_ = 0, dof_count_ = 0, free_position_ = 0;
  Pose root_pose_;                                          ///< in the file, of a root that is held by the world
  std::vector<double> armatures_, friction_losses_;         ///< of the file, one per degree of freedom of the robot
  std::vector<std::pair<int, std::pair<int, int>>> geoms_;  ///< with contype and conaffinity of the file
  std::optional<multibody::MotionType> motion_type_;        ///< that the model is set to
  bool has_forces_ = false;                                 ///< forces from outside are set
  std::vector<multibody::BodyState> body_states_;           ///< scratch
};

}  // namespace muro::mujoco
