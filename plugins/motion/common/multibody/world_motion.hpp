// SPDX-License-Identifier: MIT
// The part of a motion by a multi-body engine that does not depend on the engine. It is an external algorithm: it
// imports properties, advances its world, and exports properties (MuRoSimF, Section 3.2).
#pragma once

#include <deque>

#include "external_bodies.hpp"
#include "kinematic_robot.hpp"
#include "muro/description.hpp"
#include "muro/toolkit/pair_surface.hpp"
#include "plugins/common/mesh/hull_vertices.hpp"
#include "plugins/motion/common/motion/motion.hpp"
#include "world_robot.hpp"

namespace muro::multibody {

class WorldMotion : public Motion<Algorithm> {
 public:
  void connect(Connector& c) final;
  void start() final;
  void restored() final { start(); }
  void on_handover(std::uint32_t item) final;

 protected:
  WorldMotion() : Motion(mesh::hull_vertices) {}

  /// Description of the plugin.
  virtual const Description& description() const = 0;
  /// Smallest inertias that the engine can use.
  virtual MinInertia min_inertia() const = 0;
  /// Whether the engine uses the inertias of the model's own file instead of those of the scene.
  virtual bool has_own_inertias() const { return false; }
  /// Whether constraints of the engine couple mimic joints to their leaders. Otherwise drives make mimic joints follow,
  /// and the leaders do not feel the loads on them.
  virtual bool couples_mimics() const { return true; }
  /// Number of values that the engine itself keeps for a robot from step to step.
  virtual std::size_t memory_of(const RobotModel& model) const = 0;
  /// Reads the engine's own parameters. [setup]
  virtual void configure(Connector& c) = 0;
  /// Advice for a user when the engine's forces grow: the end of "try ...".
  virtual std::string_view advice() const = 0;
  /// Returns an empty world.
  virtual std::unique_ptr<World> make_world() const = 0;

  Vec3 gravity() const { return gravity_; }
  FrictionRule friction_rule() const { return friction_rule_; }

 private:
  void bind_by_name(Connector& c) final;
  MovedBase moved_base(std::uint32_t item) const final;
  void move(const Step& step, Range range) final;
  bool moves(std::uint32_t item) const final;
  void check_parameters(const Connector& c) const;
  void connect_robot(Connector& c, const Item& item, const Parameters& p);
  void report_regularized_links(const Connector& c) const;
  void report_mimic_joints(const Connector& c) const;
  void report_kinematic_robots(Connector& c) const;
  void step_world(const Step& step);
  void advance(double dt);

  Vec3 gravity_ = Vec3::Zero();
  FrictionRule friction_rule_ = FrictionRule::min;
  WorldRobot::WorldTraits traits_;
  double mimic_gain_ = 0;
  int substeps_ = 1;
  std::deque<WorldRobot> robots_;
  std::deque<KinematicRobot> kinematic_robots_;
  /// The robot of an item: one of the two pointers is set.
  struct Served {
    WorldRobot* by_world = nullptr;
    KinematicRobot* by_targets = nullptr;
  };
  std::vector<Served> served_;  ///< one per item
  ExternalBodies external_bodies_;
  std::unique_ptr<World> world_;
};

}  // namespace muro::multibody
