// SPDX-License-Identifier: MIT
// A walking humanoid that is observed, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/scenario/builder.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::walk_test {

inline const std::string scenario = MURO_TEST_SOURCE_DIR "/examples/walk/walk.yaml";

/// Tunables of the library, such as "forward=0.1, left=0".
inline std::string tunables(const std::string& list) { return "robots.walker.walk.tunables=[" + list + "]"; }

/// One robot of a scenario, and a hand that pushes its trunk.
class Walker {
 public:
  explicit Walker(std::vector<std::string> overrides = {}, const std::string& file = scenario) {
    if (file == scenario)
      overrides.insert(overrides.begin(), {"robots.square=off", "robots.sideways=off", "robots.lying=off"});
    built_ = host::build(host::read_scenario(file, overrides), test::plugins(), [&](Simulation& s) {
      robot_ = s.world().find_robot("walker");
      PropertyStore& store = s.world().store();
      push_ = static_cast<Wrench*>(store.bind(store.add_accessor("the test"), robot_->base(), keys::external_wrench,
                                              usage::accumulate, Multiplicity::single, 1, nullptr));
    });
    for (const Link& link : robot_->links) {
      const std::string name(world().object_name(link.object));
      const bool is_foot = name.find("foot") != name.npos;
      const Slot* const slot = world().store().find(link.object, keys::contact_wrench.name);
      if (slot) (is_foot ? feet_ : others_).push_back({name, static_cast<const Wrench*>(slot->place)});
    }
    least_height_ = pose().position.z();
  }

  World& world() { return built_.simulation->world(); }
  Simulation& simulation() { return *built_.simulation; }
  const Pose& pose() { return world().value(robot_->base(), keys::pose); }
  double yaw() { return yaw_of(pose().orientation); }
  double upright() { return (pose().orientation * Vec3::UnitZ()).z(); }
  /// Returns `walk.phase`: 1 stands, 2 walks, 3 falls, 4 gets up, 5 kicks.
  int phase() { return int(read("walk.phase")[0]); }
  const double* read(const char* property) {
    return static_cast<const double*>(world().store().find(robot_->base(), property)->place);
  }
  /// Pushes the trunk by a force (N, world axes) at a point 0.1 m above its origin.
  void push(const Vec3& force) {
    push_->force = force;
    push_->torque = Vec3(0, 0, 0.1).cross(force);
  }

  void run(double seconds) {
    const int steps = int(std::lround(seconds / 0.008));
    for (int i = 0; i < steps; ++i) {
      built_.simulation->run_for(0.008);
      least_height_ = std::min(least_height_, pose().position.z());
      least_upright_ = std::min(least_upright_, upright());
      for (const auto& [name, wrench] : others_)
        if (touched_.empty() && !wrench->force.isZero()) touched_ = name;
      int down = 0;
      for (const auto& [name, wrench] : feet_) down += wrench->force.z() > 0.3;
      ++feet_down_[std::size_t(down)];
    }
  }

  double least_height() const { return least_height_; }    ///< m, of the trunk's origin, up to now
  double least_upright() const { return least_upright_; }  ///< cosine of the largest tilt
  const std::string& touched() const { return touched_; }  ///< a link other than the feet that touched something
  /// Returns how many times none, one and both feet were on the ground.
  const std::array<int, 3>& feet_down() const { return feet_down_; }

 private:
  host::BuiltScenario built_;
  const RobotView* robot_ = nullptr;
  Wrench* push_ = nullptr;
  std::vector<std::pair<std::string, const Wrench*>> feet_, others_;
  double least_height_ = 0, least_upright_ = 1;
  std::string touched_;
  std::array<int, 3> feet_down_{};
};

}  // namespace muro::walk_test
