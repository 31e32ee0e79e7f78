// SPDX-License-Identifier: MIT
// The example, or a part of it, run and observed from outside with true poses, for tests.
#pragma once

#include <string>
#include <vector>

#include "examples/common/robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::mixed_team_test {

inline const std::string scenario = MURO_TEST_SOURCE_DIR "/examples/mixed_team/mixed_team.yaml";

/// Robots on the ground, grouped by how they move.
inline const std::vector<std::vector<std::string>> kinds = {
    {"rover"}, {"cart"}, {"walker"}, {"mates_0", "mates_1"}, {"pacer"}};

class Mission {
 public:
  explicit Mission(const std::vector<std::string>& overrides)
      : built_(host::build(host::read_scenario(scenario, overrides), test::plugins())) {}

  Simulation& simulation() { return *built_.simulation; }
  const World& world() { return built_.simulation->world(); }
  void run(double seconds) { simulation().run_for(seconds); }

  ObjectId base(const std::string& robot) { return world().find_robot(robot)->base(); }
  const Pose& pose(const std::string& robot) { return world().value(base(robot), keys::pose); }
  double score(const std::string& name, const std::string& unit = "1") {
    return example_test::values_of(world(), world_object, "score." + name, unit)[0];
  }
  double confirmed_by(const std::string& robot) {
    return example_test::values_of(world(), base(robot), "seek.confirmed")[0];
  }

  struct Told {
    Eigen::Vector2d at;
    bool confirmed;
  };
  /// Returns the crates as the base station knows them.
  std::vector<Told> targets() {
    std::vector<Told> all;
    const std::vector<double> rows = example_test::values_of(world(), base("station"), "mission.targets", "m, m, 1, 1");
    for (std::size_t i = 0; i < rows.size(); i += 4)
      if (rows[i + 2] != 0) all.push_back({{rows[i], rows[i + 1]}, rows[i + 3] != 0});
    return all;
  }
  /// Returns the true places of the crates, m.
  std::vector<Eigen::Vector2d> crates() {
    std::vector<Eigen::Vector2d> all;
    for (const RobotView* r : world().robots())
      if (r->name.rfind("crates", 0) == 0) all.push_back(pose(std::string(r->name)).position.head<2>());
    return all;
  }
  /// Returns the distance from a point to the nearest crate, m.
  double off(const Eigen::Vector2d& p) {
    double least = 1e9;
    for (const Eigen::Vector2d& c : crates()) least = std::min(least, (p - c).norm());
    return least;
  }

 private:
  host::BuiltScenario built_;
};

/// Returns overrides with a crate before each robot on the ground, and the flying one high above: a short mission.
inline std::vector<std::string> crates_ahead(std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"robots.crates.count=6",
               "robots.crates.place={list: [{x: -5, y: -5.7}, {x: -3, y: -5.7}, {x: -1.5, y: -5.7}, {x: 0, y: -5.7}, "
               "{x: 3, y: -5.7}, {x: 5, y: -5.7}]}",
               "robots.flyer.at={x: 0, y: -5.7, z: 10, yaw: 1.5707963}",
               "robots.flyer.survey.tunables=[altitude=10, center_y=-5.7, size_x=1, size_y=1, least_sightings=2]"});
  return more;
}

}  // namespace muro::mixed_team_test
