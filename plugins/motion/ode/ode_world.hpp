// SPDX-License-Identifier: MIT
#pragma once

#include "robot.hpp"
#include "settings.hpp"

namespace muro::ode {

/// Makes ODE ready for use in this process; once is enough. [any thread]
void start_engine();

/// A world of ODE.
///
/// A step follows from the state of the robots alone: bodies are placed anew in each, contacts are made in the order of
/// their geoms, and the random numbers with which ODE's solver shuffles its rows begin anew.
class OdeWorld final : public multibody::World {
 public:
  OdeWorld(const Settings& settings, std::shared_ptr<const Meshes> meshes);
  ~OdeWorld() override;

  void add_scenery(const multibody::Fixture& fixture) override;
  void add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  struct Obstacle {
    const multibody::FixtureState* state;
    dBodyID body;
    std::vector<dGeomID> geoms;
    bool present = true;
  };
  struct Pair {
    dGeomID first, second;  ///< the first belongs to a robot of this world
    std::uint32_t a, b;     ///< their numbers
  };
  struct Touch {
    dContact contact{};
    const Owner *first = nullptr, *second = nullptr;
  };

  static const Owner& owner_of(dGeomID geom) { return *static_cast<const Owner*>(dGeomGetData(geom)); }
  static void meet(void* self, dGeomID a, dGeomID b);
  void add_pair(dGeomID a, dGeomID b);
  bool may_touch(const Owner& a, const Owner& b) const;
  void import(Obstacle& o) const;
  void find_pairs();
  void find_touches();
  void make_contacts();
  void carry_on(double dt);
  void export_contacts();
  void mark(dGeomID geom, const multibody::PartShape& shape);

  Settings settings_;
  std::shared_ptr<const Meshes> meshes_;
  dWorldID world_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dSpaceID scenery_ = nullptr, others_ = nullptr, team_ = nullptr;
  std::vector<dGeomID> planes_;
  std::deque<Owner> owners_;
  std::deque<Obstacle> obstacles_;
  std::deque<Robot> robots_;
  std::vector<Pair> pairs_;
  std::vector<Touch> touches_;  ///< the first `touch_count_` count
  std::size_t touch_count_ = 0;
  std::vector<dJointFeedback> feedbacks_;  ///< of the contacts
};

}  // namespace muro::ode
