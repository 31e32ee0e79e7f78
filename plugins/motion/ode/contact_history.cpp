// SPDX-License-Identifier: MIT
#include "contact_history.hpp"

namespace muro::ode {

namespace {

constexpr double max_distance = 0.01;  ///< m: a point that is farther from the stored place is another point
constexpr double taken = -1;           ///< stored instead of the pair when the point has been used

/// Returns a number for the pair of geoms, exact as a double and not 0.
double pair_of(const FoundContact& c) { return double((std::uint64_t(c.first->number) << 26) + c.second->number + 1); }

}  // namespace

std::size_t ContactHistory::size_of(const multibody::RobotModel& model) {
  constexpr std::size_t of_robot = 8, of_shape = 4;
  std::size_t points = of_robot;
  for (const multibody::RigidBody& body : model.bodies) points += of_shape * body.shapes.size();
  return points * numbers;
}

void ContactHistory::recall(FoundContact& c) {
  const double pair = pair_of(c);
  const Vec3 point = c.point();
  double nearest = max_distance * max_distance;
  double* found = nullptr;
  for (std::size_t i = 0; i < memory_.size() && memory_[i] != 0; i += numbers) {
    if (memory_[i] != pair) continue;
    const double distance = (vector_of(&memory_[i + 1]) - point).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    found = &memory_[i];
  }
  c.drift = c.load = Vec3::Zero();
  c.pressure = 0;
  c.bound = 1;
  if (!found) return;
  c.drift = vector_of(found + 4);
  c.load = vector_of(found + 7);
  c.pressure = found[10];
  c.bound = found[11];
  found[0] = taken;
}

void ContactHistory::store(const FoundContact& c, const Vec3& next_point) {
  if (stored_ + numbers > memory_.size()) return;
  double* const m = &memory_[stored_];
  m[0] = pair_of(c);
  std::copy_n(next_point.data(), 3, m + 1);
  std::copy_n(c.drift.data(), 3, m + 4);
  std::copy_n(c.load.data(), 3, m + 7);
  m[10] = c.pressure;
  m[11] = c.bound;
  stored_ += numbers;
  if (stored_ < memory_.size()) memory_[stored_] = 0;
}

}  // namespace muro::ode
