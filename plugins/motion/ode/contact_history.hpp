// SPDX-License-Identifier: MIT
#pragma once

#include "found_contact.hpp"

namespace muro::ode {

/// What contacts of a robot carry from step to step, in RobotState::memory.
///
/// ODE's iterations begin anew in each step and leave a little of each speed, so that what friction holds would creep.
/// How far it has crept, the drift, is what friction takes back. The load tells where
/// the cone of friction bounds it, and the bound by how much ODE's direct solver is wrong there, which takes the normal
/// forces of a step without friction for those with it.
class ContactHistory {
 public:
  static std::size_t size_of(const multibody::RobotModel& model);

  explicit ContactHistory(std::span<double> memory) : memory_(memory) {}
  void clear() { memory_[0] = 0; }
  /// Gives the contact what the nearest point of its pair of shapes has left, once to each.
  void recall(FoundContact& contact);
  /// Forgets all, and stores what follows.
  void begin() { stored_ = 0, memory_[0] = 0; }
  /// `next_point`: where the contact will be in the next step.
  void store(const FoundContact& contact, const Vec3& next_point);

 private:
  static constexpr std::size_t numbers = 12;  ///< of a point: pair, point, drift, load, pressure, bound

  std::span<double> memory_;  ///< points, to the first without a pair
  std::size_t stored_ = 0;
};

}  // namespace muro::ode
