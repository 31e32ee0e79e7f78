// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "mjcf.hpp"
#include "mujoco_contacts.hpp"
#include "mujoco_library.hpp"
#include "mujoco_robot.hpp"

namespace muro::mujoco {

/// A world of MuJoCo: one model and its data.
class MujocoWorld final : public multibody::World {
 public:
  MujocoWorld(const MujocoSettings& settings, const MujocoMeshes& meshes, std::shared_ptr<WarningLog> warnings)
      : settings_(settings), meshes_(&meshes), mjcf_(meshes), warnings_(std::move(warnings)) {}

  void add_static_body(const multibody::ExternalBody& body) override;
  void add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  struct StaticBody {
    const multibody::ExternalBody* body;
    std::size_t owner;
  };
  struct KinematicBody {
    const multibody::ExternalBody* body;
    const multibody::ExternalBodyState* state;
    std::size_t owner;
    int index = -1, mocap = -1;  ///< in the model
    bool enabled = true;
  };
  struct DofOwner {
    std::size_t robot = 0, body = 0;
  };

  void find_indices();
  void set_time_step(double dt);
  void allocate_data();
  void import(KinematicBody& body);
  void step();
  void solve();
  void split_step();
  void check_inertia() const;
  void set_softness();
  void set_references();

  MujocoSettings settings_;
  const MujocoMeshes* meshes_;
  Mjcf mjcf_;
  std::shared_ptr<WarningLog> warnings_;
  std::size_t owners_ = 0;
  std::vector<StaticBody> static_bodies_;
  std::deque<KinematicBody> kinematic_bodies_;
  std::deque<MujocoRobot> robots_;
  Model model_;
  Data data_;
  MujocoContacts contacts_;
  std::vector<DofOwner> dof_owners_;            ///< one per degree of freedom
  std::vector<DofDrive> dof_drives_;            ///< the same
  std::vector<mjtNum> positions_, velocities_;  ///< scratch: see split_step
  double dt_ = 0;
  double stack_factor_ = 1;
};

}  // namespace muro::mujoco
