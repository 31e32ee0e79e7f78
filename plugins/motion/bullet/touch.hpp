// SPDX-License-Identifier: MIT
// A contact point between its finding and its answer.
#pragma once

#include "narrow_phase.hpp"
#include "robot.hpp"

namespace muro::bullet {

struct Touch {
  const Collider* a = nullptr;  ///< of a simulated robot
  const Collider* b = nullptr;
  ContactPoint at;
  Vec3 slip = Vec3::Zero();     ///< m/s: velocity of `a` against `b` at the point at the start of the step
  Vec3 along, across;           ///< unit: directions of friction
  Vec3 impulse = Vec3::Zero();  ///< N s, on `a`: before solve() a guess, then what it found
  int row = -1;                 ///< in the solver; -1: too far away to matter
};

/// What RobotState::memory holds: impulses of drives, then of contacts. The solver begins the next step with them, as
/// Bullet does with what its contact caches hold.
class Memory {
 public:
  static std::size_t size_of(const multibody::RobotModel& model);

  Memory(const multibody::RobotModel& model, std::span<double> memory);
  void forget() const;
  double& drive(std::size_t part) const { return drives_[part - 1]; }
  /// Gives each touch the impulse of the nearest point of the last step, each of which counts once.
  void recall(std::span<Touch> touches) const;
  /// Of what recall() has left, nothing stays.
  void keep(std::span<const Touch> touches) const;

 private:
  static constexpr std::size_t points = 4;   ///< of a shape
  static constexpr std::size_t numbers = 7;  ///< of a point: 1 + number of the other collider, point, impulse
  std::span<double> drives_, contacts_;
};

}  // namespace muro::bullet
