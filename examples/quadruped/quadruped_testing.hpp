// SPDX-License-Identifier: MIT
// A trotting robot that is observed, for tests.
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

namespace muro::quadruped_test {

inline const std::string scenario = MURO_TEST_SOURCE_DIR "/examples/quadruped/quadruped.yaml";
inline constexpr double degree = M_PI / 180;

/// Observations of a robot since the last `forget`.
struct Seen {
  double lowest = 1e9, highest = -1e9;  ///< m: origin of the base
  double most_tilt = 0;                 ///< rad
  std::string touched;                  ///< a link other than the feet, if one touched something
  double off = 0;                       ///< m/s: largest error of its estimated velocity along the ground
};

/// One robot of a scenario, and a hand that pushes its base.
class Walk {
 public:
  Walk(const std::string& file, const std::vector<std::string>& overrides, const std::string& robot = "walker") {
    built_ = host::build(host::read_scenario(file, overrides), test::plugins(), [&](Simulation& s) {
      robot_ = s.world().find_robot(robot);
      push_ = example_test::add_push(s.world(), *robot_);
    });
    contacts_ = example_test::contacts_of(world(), *robot_);
  }
  /// Returns overrides without the robots that the example is not about.
  static std::vector<std::string> alone(std::vector<std::string> more = {}) {
    more.insert(more.end(), {"robots.mates=off", "robots.a1=off"});
    return more;
  }

  World& world() { return built_.simulation->world(); }
  Simulation& simulation() { return *built_.simulation; }
  const Pose& pose() { return world().value(robot_->base(), keys::pose); }
  const Twist& twist() { return world().value(robot_->base(), keys::twist); }
  double yaw() { return yaw_of(pose().orientation); }
  /// Returns the velocity, m/s, in a level frame with the heading of the robot.
  Vec3 velocity() { return Eigen::AngleAxisd(-yaw(), Vec3::UnitZ()) * twist().linear; }
  void push(const Vec3& force) { push_->force = force; }
  void forget() { seen = Seen{}; }
  /// Returns shares of the time in which 0, 1, ... 4 feet carried something, by the forces of contacts.
  std::vector<double> feet_down(double seconds) {
    std::vector<double> counts(5, 0);
    const int steps = int(std::lround(seconds / 0.005));
    for (int i = 0; i < steps; ++i) {
      run(0.005);
      std::size_t down = 0;
      for (const auto& contact : contacts_) down += contact.is_foot() && contact.wrench->force.norm() > 1;
      counts[down] += 1.0 / steps;
    }
    return counts;
  }

  void run(double seconds) {
    const int steps = int(std::lround(seconds / 0.005));
    for (int i = 0; i < steps; ++i) {
      built_.simulation->run_for(0.005);
      const Pose& p = pose();
      seen.lowest = std::min(seen.lowest, p.position.z());
      seen.highest = std::max(seen.highest, p.position.z());
      seen.most_tilt = std::max(seen.most_tilt, std::acos(std::min(1.0, (p.orientation * Vec3::UnitZ()).z())));
      const Slot* const told = world().store().find(robot_->base(), "trot.velocity");
      const auto* const v = static_cast<const double*>(told->place);
      seen.off = std::max(seen.off, std::hypot(v[0] - velocity().x(), v[1] - velocity().y()));
      for (const auto& contact : contacts_)
        if (!contact.is_foot() && contact.wrench->force.norm() > 0) seen.touched = contact.link;
    }
  }

  Seen seen;

 private:
  host::BuiltScenario built_;
  const RobotView* robot_ = nullptr;
  Wrench* push_ = nullptr;
  std::vector<example_test::LinkContact> contacts_;
};

}  // namespace muro::quadruped_test
