// SPDX-License-Identifier: MIT
#pragma once

#include "ode_robot.hpp"
#include "ode_settings.hpp"
#include "plugins/common/engines/ode/error_trap.hpp"
#include "split_step.hpp"

namespace muro::ode {

/// A world of ODE.
///
/// A step depends only on the state of the robots. In each step poses of bodies are set anew, contacts are made in the
/// order of their geoms, and the random numbers with which ODE's solver shuffles its rows start anew.
class OdeWorld final : public multibody::World {
 public:
  OdeWorld(const OdeSettings& settings, std::shared_ptr<const OdeMeshes> meshes, std::shared_ptr<MessageLog> messages);
  ~OdeWorld() override;

  void add_static_body(const multibody::ExternalBody& body) override;
  void add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  struct KinematicBody {
    const multibody::ExternalBodyState* state;
    dBodyID body;
    std::vector<dGeomID> geoms;
    bool enabled = true;
  };
  struct Pair {
    dGeomID first, second;  ///< the first belongs to a robot of this world
    std::uint32_t a, b;     ///< their numbers
  };

  static const GeomOwner& owner_of(dGeomID geom) { return *static_cast<const GeomOwner*>(dGeomGetData(geom)); }
  static void near_callback(void* self, dGeomID a, dGeomID b);
  void add_pair(dGeomID a, dGeomID b);
  bool may_collide(const GeomOwner& a, const GeomOwner& b) const;
  void import(KinematicBody& body) const;
  void find_pairs();
  void find_contacts();
  static int collide(const Pair& pair, FoundContact* found);
  static int collide_with_terrain(const Pair& pair, FoundContact* found);
  void set_step(double dt);
  double inverse_mass_of(const FoundContact& found) const;
  void find_patches();
  void describe_contacts();
  void describe_normal(FoundContact& found, double restitution) const;
  void describe_friction(FoundContact& found) const;
  void move_friction(FoundContact& found) const;
  double resting_softness(const FoundContact& found) const;
  double rebound_speed(const FoundContact& found, double restitution, double approach) const;
  void leave_overlap(FoundContact& found) const;
  void create_contact_joint(FoundContact& found);
  void step_world(double dt);
  void step_again(double dt);
  bool moves(const GeomOwner& owner) const;
  void tell_contact(const FoundContact& found, bool to_first);
  void remember(FoundContact& found);
  void export_contacts();
  GeomOwner& set_owner(dGeomID geom, const multibody::BodyShape& shape);
  /// Calls ODE and turns its errors into exceptions.
  template <class Work>
  void guarded(const Work& work);

  OdeSettings settings_;
  double dt_ = 0;
  std::shared_ptr<const OdeMeshes> meshes_;
  std::shared_ptr<MessageLog> messages_;
  bool has_failed_ = false;  ///< after an error of ODE, nothing of it can be used or destroyed
  dThreadingImplementationID threading_ = nullptr;
  dWorldID world_ = nullptr;
  dJointGroupID contact_joints_ = nullptr;
  dSpaceID static_space_ = nullptr, kinematic_space_ = nullptr, robot_space_ = nullptr;
  std::vector<dGeomID> grounds_;  ///< planes, including those that represent heightmaps
  std::deque<GeomOwner> owners_;
  std::deque<KinematicBody> kinematic_bodies_;
  std::deque<OdeRobot> robots_;
  std::vector<Pair> pairs_;
  std::vector<FoundContact> found_contacts_;  ///< the first `contact_count_` are valid
  std::size_t contact_count_ = 0;
  SplitStep split_step_;
};

}  // namespace muro::ode
