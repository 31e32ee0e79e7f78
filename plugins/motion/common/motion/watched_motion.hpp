// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "motion.hpp"
#include "plugins/common/mesh/hull_vertices.hpp"
#include "plugins/motion/common/watch/robot_watch.hpp"

namespace muro {

/// A motion by forces whose contacts a collision algorithm finds. It watches its robots, each `RobotWatch::interval`
/// steps, and ends the run when the numbers of one are no longer those of bodies.
class WatchedMotion : public Motion<Algorithm> {
 protected:
  WatchedMotion() : Motion(mesh::hull_vertices) {}

  /// Watches item `i`; again: with the joints that it has now. `velocities`: see RobotWatch. [setup]
  void watch_robot(Connector& c, std::uint32_t i, std::span<const double* const> velocities) {
    watches_.resize(c.items().size());
    watches_[i].emplace(c, *c.items()[i].robot, velocities);
  }
  /// Begins the watch over item `i`, at the start of a run and wherever its state jumps. `external`: wrenches that act
  /// on it; null: none. [between steps]
  void begin_watch(std::uint32_t i, const SumIn<Wrench>* external) { watches_[i]->begin(external); }

  /// Binds the robots; see Algorithm::connect_by_name. [setup]
  virtual void bind_robots_by_name(Connector& c) = 0;
  /// Returns pose and twist of the base of a watched item. [step]
  virtual std::pair<Pose, Twist> state_of(std::uint32_t i) const = 0;

  void bind_by_name(Connector& c) final {
    bind_robots_by_name(c);
    surroundings_.connect(c);
    for (std::optional<watch::RobotWatch>& w : watches_)
      if (w) w->connect_contacts(c);
  }
  /// Throws Error when the watch over one of the robots ends the run.
  bool prepare(const Step& step, Range range) override {
    if (step.index % watch::RobotWatch::interval != 0 || watches_.empty()) return true;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      if (!watches_[i]) continue;
      const auto [pose, twist] = state_of(i);
      watches_[i]->look(step, pose, twist, surroundings_);
    }
    return true;
  }

 private:
  std::vector<std::optional<watch::RobotWatch>> watches_;  ///< by item; none: no force moves it
  watch::Surroundings surroundings_;
};

}  // namespace muro
