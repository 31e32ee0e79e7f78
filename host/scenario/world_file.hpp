// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/scenario.hpp"
#include "host/scenario/section.hpp"

namespace muro::host {

/// What the file of `world: {file: ...}` brings into a scenario: gravity, scenery, and models. A model that the
/// scenario names as a robot (`model: world`) becomes that robot; the others stand still.
class WorldFileParts {
 public:
  /// What readers say goes to `notes`, what is wrong to `problems`.
  WorldFileParts(const Scenario& scenario, Simulation& simulation, std::vector<std::string>& notes, Problems& problems)
      : scenario_(scenario), simulation_(simulation), notes_(notes), problems_(problems) {}

  void read();
  Vec3 gravity() const;
  /// Adds what stands still, and what of it random places keep clear of.
  void add_scenery(std::vector<Obstacle>& obstacles);
  /// The model that a template takes from the file. Throws SetupError when there is none, or it is no robot.
  RobotTree model(const RobotTemplate& t) const;
  /// Of its base; for a template whose model was found.
  const Pose& pose(const RobotTemplate& t) const;

 private:
  const WorldModel::Model* find(const std::string& name) const;
  void note(const std::vector<RobotTree::Problem>& problems, const std::string& prefix, bool demote);
  void stand_still(const WorldModel::Model& model, std::vector<Obstacle>& obstacles);
  void add(const std::string& name, const Pose& pose, std::vector<Shape> collisions, std::vector<Shape> visuals,
           const std::vector<std::string>& texts, std::vector<Obstacle>& obstacles);

  const Scenario& scenario_;
  Simulation& simulation_;
  std::vector<std::string>& notes_;
  Problems& problems_;
  std::optional<WorldModel> world_;
};

}  // namespace muro::host
