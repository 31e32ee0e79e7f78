// SPDX-License-Identifier: MIT
#include "host/compare/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

void Trajectory::sample(const Simulation& simulation) {
  const World& world = simulation.world();
  for (const std::uint32_t r : robots_) {
    const Pose& pose = world.value(world.robots()[r]->base(), keys::pose);
    samples_.push_back({pose.position, yaw_of(pose.orientation)});
  }
}

double Trajectory::distance() const {
  const std::size_t n = robots_.size();
  double sum = 0;
  for (std::size_t i = n; i < samples_.size(); ++i) sum += (samples_[i].position - samples_[i - n].position).norm();
  return n > 0 ? sum / double(n) : 0;
}

Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference) {
  Deviation d;
  const std::size_t n = std::min(trajectory.samples_.size(), reference.samples_.size());
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Trajectory::Sample &a = trajectory.samples_[i], &b = reference.samples_[i];
    const double distance = (a.position - b.position).norm();
    squares += distance * distance;
    d.position_largest = std::max(d.position_largest, distance);
    d.heading_largest = std::max(d.heading_largest, std::abs(std::remainder(a.heading - b.heading, 2 * M_PI)));
  }
  if (n > 0) d.position_rms = std::sqrt(squares / double(n));
  return d;
}

}  // namespace muro::host
