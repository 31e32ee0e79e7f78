// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/mesh_corners.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"
#include "host/scenario/unreadable_meshes.hpp"

namespace muro::host {

/// The contents that the file of `world: {file: ...}` adds to a scenario: gravity, scenery, and models. A model that
/// the scenario names as a robot (`model: world`) becomes that robot; the others are static.
class WorldFileContents {
 public:
  /// Warnings and notes of readers go to `out`, errors to `problems`.
  WorldFileContents(BuiltScenario& out, MeshCorners& meshes, UnreadableMeshes& unreadable_meshes, Problems& problems)
      : out_(out),
        scenario_(out.scenario),
        simulation_(*out.simulation),
        meshes_(meshes),
        unreadable_meshes_(unreadable_meshes),
        problems_(problems) {}

  void read();
  Vec3 gravity() const;
  /// Returns the friction rule of the scenario, or that of the file, or else `min`.
  FrictionRule friction_rule() const;
  /// Adds all static bodies, and adds to `occupied` what random placement must avoid.
  void add_scenery(Occupancy& occupied);
  /// Returns the model that a template takes from the file. Throws SetupError when there is none, or it is no robot.
  RobotTree model(const RobotTemplate& t) const;
  /// Returns the pose of the model's base; for a template that has a model().
  const Pose& pose(const RobotTemplate& t) const;

 private:
  const WorldModel::Model* find(const std::string& name) const;
  /// `errors_too`: errors are noted as warnings, because the scenario does not use the model.
  void note(const std::vector<RobotTree::Problem>& problems, bool errors_too);
  void add_static(const WorldModel::Model& model, Occupancy& occupied);
  void add(const std::string& name, const Pose& pose, std::vector<Shape> collisions, std::vector<Shape> visuals,
           const TextTable& texts, Occupancy& occupied);

  BuiltScenario& out_;
  const Scenario& scenario_;
  Simulation& simulation_;
  MeshCorners& meshes_;
  UnreadableMeshes& unreadable_meshes_;
  Problems& problems_;
  std::optional<WorldModel> world_;
};

}  // namespace muro::host
