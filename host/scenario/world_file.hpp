// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/mesh_corners.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// What the file of `world: {file: ...}` adds to a scenario: gravity, scenery, and models. A model that the scenario
/// names as a robot (`model: world`) becomes that robot; the others are static.
class WorldFileContents {
 public:
  /// Warnings and notes of readers go to `notes`, errors to `problems`.
  WorldFileContents(const Scenario& scenario, Simulation& simulation, MeshCorners& meshes,
                    std::vector<std::string>& notes, Problems& problems)
      : scenario_(scenario), simulation_(simulation), meshes_(meshes), notes_(notes), problems_(problems) {}

  void read();
  Vec3 gravity() const;
  /// The scenario's, else what models of the file say of their format, else the smaller.
  FrictionRule friction_rule() const;
  /// Adds all that is static, and to `occupied` what random placement keeps clear of.
  void add_scenery(Occupancy& occupied);
  /// The model that a template takes from the file. Throws SetupError when there is none, or it is no robot.
  RobotTree model(const RobotTemplate& t) const;
  /// Of its base; for a template whose model() was found.
  const Pose& pose(const RobotTemplate& t) const;

 private:
  const WorldModel::Model* find(const std::string& name) const;
  /// `errors_too`: errors are noted as warnings, because the scenario does not use the model.
  void note(const std::vector<RobotTree::Problem>& problems, bool errors_too);
  void add_static(const WorldModel::Model& model, Occupancy& occupied);
  void add(const std::string& name, const Pose& pose, std::vector<Shape> collisions, std::vector<Shape> visuals,
           const TextTable& texts, Occupancy& occupied);

  const Scenario& scenario_;
  Simulation& simulation_;
  MeshCorners& meshes_;
  std::vector<std::string>& notes_;
  Problems& problems_;
  std::optional<WorldModel> world_;
};

}  // namespace muro::host
