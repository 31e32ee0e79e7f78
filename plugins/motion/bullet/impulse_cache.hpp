// SPDX-License-Identifier: MIT
#pragma once

#include "solver_contact.hpp"

namespace muro::bullet {

/// The contents of RobotState::memory: impulses of drives, then of contacts. The solver begins the next step with them
/// (warm start), like Bullet with its contact caches.
class ImpulseCache {
 public:
  static std::size_t size_of(const multibody::RobotModel& model);

  ImpulseCache(const multibody::RobotModel& model, std::span<double> memory);
  void clear() const;
  double& drive(std::size_t body) const { return drives_[body - 1]; }
  /// Gives each contact the impulse of the nearest point of the last step. Each point is used once.
  void match(std::span<SolverContact> contacts) const;
  /// Replaces all impulses of contacts.
  void store(std::span<const SolverContact> contacts) const;

 private:
  static constexpr std::size_t points = 4;   ///< per shape
  static constexpr std::size_t numbers = 7;  ///< per point: 1 + number of the other collider, point, impulse
  std::span<double> drives_, contacts_;
};

}  // namespace muro::bullet
