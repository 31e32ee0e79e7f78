// SPDX-License-Identifier: MIT
#include "host/outputs/odometer.hpp"

#include <fmt/format.h>

#include <utility>

#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

bool is_finite(const Pose& p) { return p.position.allFinite() && p.orientation.coeffs().allFinite(); }

}  // namespace

const Pose& base_pose(const Simulation& simulation, const RobotView& robot) {
  return simulation.world().value(robot.base(), keys::pose);
}

Odometer::Odometer(const Simulation& simulation) : simulation_(simulation) {
  for (const RobotView* r : simulation.world().robots()) last_.push_back(base_pose(simulation, *r).position);
  distances_.assign(last_.size(), 0);
}

void Odometer::sample() {
  const bool jumped = std::exchange(jumps_, simulation_.jumps()) != simulation_.jumps();
  for (const RobotView* r : simulation_.world().robots()) {
    const Vec3& now = base_pose(simulation_, *r).position;
    if (!jumped) distances_[index_of(r->id)] += (now - last_[index_of(r->id)]).norm();
    last_[index_of(r->id)] = now;
  }
}

void Odometer::check() const {
  for (const RobotView* r : simulation_.world().robots())
    if (!is_finite(base_pose(simulation_, *r)))
      throw StepError(fmt::format(
          "the pose of robot `{}` is not finite any more at t = {:g} s; try a higher rate of its motion, or "
          "weaker forces",
          r->name, 1e-9 * double(simulation_.now())));
}

}  // namespace muro::host
