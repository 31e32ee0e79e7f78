// SPDX-License-Identifier: MIT
#include "impulse_cache.hpp"

#include <algorithm>

namespace muro::bullet {

namespace {

constexpr double max_distance = 0.02;  ///< m: a point that is farther away than this is another point

constexpr double taken = -1;  ///< replaces the number of the other collider when a point has been matched

std::size_t shape_count(const multibody::RobotModel& model) {
  std::size_t n = 0;
  for (const multibody::RigidBody& body : model.bodies) n += body.shapes.size();
  return n;
}

}  // namespace

std::size_t ImpulseCache::size_of(const multibody::RobotModel& model) {
  return model.bodies.size() - 1 + shape_count(model) * points * numbers;
}

ImpulseCache::ImpulseCache(const multibody::RobotModel& model, std::span<double> memory)
    : drives_(memory.first(model.bodies.size() - 1)), contacts_(memory.subspan(model.bodies.size() - 1)) {}

void ImpulseCache::clear() const {
  std::fill(drives_.begin(), drives_.end(), 0);
  std::fill(contacts_.begin(), contacts_.end(), 0);
}

void ImpulseCache::match(std::span<SolverContact> contacts) const {
  for (SolverContact& c : contacts) {
    c.impulse = Vec3::Zero();
    double nearest = max_distance * max_distance;
    double* found = nullptr;
    for (std::size_t i = 0; i < points; ++i) {
      double* m = &contacts_[(c.a->shape_index * points + i) * numbers];
      if (m[0] == 0) break;
      if (m[0] != double(c.b->number) + 1) continue;
      const double distance = (Vec3(m[1], m[2], m[3]) - c.point.position).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = m;
    }
    if (!found) continue;
    c.impulse = Vec3(found[4], found[5], found[6]);
    found[0] = taken;
  }
}

void ImpulseCache::store(std::span<const SolverContact> contacts) const {
  for (std::size_t i = 0; i < contacts_.size(); i += numbers) contacts_[i] = 0;
  for (const SolverContact& c : contacts) {
    if (c.row < 0 || c.impulse.isZero(0)) continue;
    for (std::size_t i = 0; i < points; ++i) {
      double* m = &contacts_[(c.a->shape_index * points + i) * numbers];
      if (m[0] != 0) continue;
      m[0] = double(c.b->number) + 1;
      std::copy_n(c.point.position.data(), 3, m + 1);
      std::copy_n(c.impulse.data(), 3, m + 4);
      break;
    }
  }
}

}  // namespace muro::bullet
