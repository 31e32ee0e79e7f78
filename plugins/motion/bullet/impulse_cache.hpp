// SPDX-License-Identifier: MIT
#pragma once

#include "solver_contact.hpp"

namespace muro::bullet {

/// What RobotState::memory holds: impulses of drives, then of contacts. The solver begins the next step with them (warm
/// start), as Bullet does with what its contact caches hold.
class ImpulseCache {
 public:
  static std::size_t size_of(const multibody::RobotModel& model);

  ImpulseCache(const multibody::RobotModel& model, std::span<double> memory);
  void clear() const;
  double& drive(std::size_t body) const { return drives_[body - 1]; }
  /// Gives each contact the impulse of the nearest point of the last step, each of which is taken once.
  void match(std::span<SolverContact> contacts) const;
  /// Replaces all impulses of contacts.
  void store(std::span<const SolverContact> contacts) const;

 private:
  static constexpr std::size_t points = 4;   ///< of a shape
  static constexpr std::size_t numbers = 7;  ///< of a point: 1 + number of the other collider, point, impulse
  std::span<double> drives_, contacts_;
};

}  // namespace muro::bullet
