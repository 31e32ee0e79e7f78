// SPDX-License-Identifier: MIT
#include "host/compare/track.hpp"

#include <algorithm>
#include <cmath>

#include "muro/vocabulary.hpp"

namespace muro::host {

void Track::look(const Simulation& simulation) {
  const World& world = simulation.world();
  for (const std::uint32_t r : robots_) {
    const Pose& pose = world.value(world.robots()[r]->base(), keys::pose);
    spots_.push_back({pose.position, yaw_of(pose.orientation)});
  }
}

double Track::distance() const {
  const std::size_t n = robots_.size();
  double sum = 0;
  for (std::size_t i = n; i < spots_.size(); ++i) sum += (spots_[i].position - spots_[i - n].position).norm();
  return n > 0 ? sum / double(n) : 0;
}

Deviation deviation_of(const Track& track, const Track& reference) {
  Deviation d;
  const std::size_t n = std::min(track.spots_.size(), reference.spots_.size());
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Track::Spot &a = track.spots_[i], &b = reference.spots_[i];
    const double apart = (a.position - b.position).norm();
    squares += apart * apart;
    d.position_largest = std::max(d.position_largest, apart);
    d.heading_largest = std::max(d.heading_largest, std::abs(std::remainder(a.heading - b.heading, 2 * M_PI)));
  }
  if (n > 0) d.position_rms = std::sqrt(squares / double(n));
  return d;
}

}  // namespace muro::host
