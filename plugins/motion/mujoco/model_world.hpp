// SPDX-License-Identifier: MIT
// A world of MuJoCo from an unchanged MJCF file. Options, contact parameters, friction and actuators are those of the
// file; a step is mj_step. Other bodies of the scene become geoms in the file's world.
#pragma once

#include <deque>

#include "mjcf.hpp"
#include "model_robot.hpp"

namespace muro::mujoco {

class ModelWorld final : public multibody::World {
 public:
  ModelWorld(const ModelSource& source, const MujocoMeshes& meshes, Host& host);

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

  void find_robots();
  void leave_out_other_parts();
  void find_scenery();
  void find_kinematic_bodies();
  void set_time_step(double dt);
  void import(KinematicBody& body);
  bool step();
  void report_contacts();
  void set_obstacle(int geom, const StaticBody& body);
  void tell_contact(const mjContact& contact, const std::int32_t (&owners)[2], const Vec3& force,
                    const Vec3& torque) const;

  const ModelSource& source_;
  Host& host_;
  Mjcf mjcf_;
  std::size_t owners_ = 0;
  std::vector<StaticBody> static_bodies_;  ///< bodies that are not in the file, or may be
  std::deque<KinematicBody> kinematic_bodies_;
  std::deque<ModelRobot> robots_;
  CompiledFile file_;
  Data data_;
  std::vector<std::int32_t> robot_of_body_;    ///< one per body in MuJoCo; -1: none
  std::vector<const std::string*> obstacles_;  ///< one per geom: the name of its scenery, or null
  std::vector<ObjectId> objects_;              ///< one per geom: object that has the shape, if any
  std::vector<int> held_joints_;               ///< joints of trees that are no robots
  double dt_ = 0;
};

}  // namespace muro::mujoco
