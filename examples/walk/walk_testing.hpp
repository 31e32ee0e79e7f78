// SPDX-License-Identifier: MIT
// A walking humanoid that is observed, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "examples/common/robot_testing.hpp"
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
      push_ = example_test::add_push(s.world(), *robot_);
    });
    contacts_ = example_test::contacts_of(world(), *robot_);
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
      int down = 0;
      for (const auto& contact : contacts_) {
        if (contact.is_foot())
          down += contact.wrench->force.z() > 0.3;
        else if (touched_.empty() && !contact.wrench->force.isZero())
          touched_ = contact.link;
      }
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
  std::vector<example_test::LinkContact> contacts_;
  double least_height_ = 0, least_upright_ = 1;
  std::string touched_;
  std::array<int, 3> feet_down_{};
};

}  // namespace muro::walk_test
