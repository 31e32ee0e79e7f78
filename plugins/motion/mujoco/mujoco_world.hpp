// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "contacts.hpp"
#include "engine.hpp"
#include "mjcf.hpp"
#include "robot.hpp"

namespace muro::mujoco {

/// A world of MuJoCo: one model and its data.
class MujocoWorld final : public multibody::World {
 public:
  MujocoWorld(const Settings& settings, const Meshes& meshes) : settings_(settings), mjcf_(meshes) {}

  void add_scenery(const multibody::Fixture& fixture) override;
  void add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  struct Scenery {
    const multibody::Fixture* fixture;
    std::size_t owner;
  };
  struct Obstacle {
    const multibody::Fixture* fixture;
    const multibody::FixtureState* state;
    std::size_t owner;
    int body = -1, mocap = -1;
    bool present = true;
  };
  struct Drive {
    std::size_t robot = 0, part = 0;
  };

  void find_bodies();
  void set_step(double dt);
  void make_room();
  void import(Obstacle& o);
  void step();
  void set_references();

  Settings settings_;
  Mjcf mjcf_;
  std::size_t owners_ = 0;
  std::vector<Scenery> scenery_;
  std::deque<Obstacle> obstacles_;
  std::deque<Robot> robots_;
  Model model_;
  Data data_;
  Contacts contacts_;
  std::vector<Drive> drives_;   ///< one a degree of freedom
  std::vector<double> wanted_;  ///< one a degree of freedom: the speed that its drive or friction holds
  double dt_ = 0;
  double stack_factor_ = 1;
};

}  // namespace muro::mujoco
