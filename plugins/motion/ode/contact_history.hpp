// SPDX-License-Identifier: MIT
#pragma once

#include "found_contact.hpp"

namespace muro::ode {

/// Data that contacts of a robot keep from step to step, in RobotState::memory.
///
/// ODE's iterations start anew in each step and leave a small part of each speed. So a contact that friction holds
/// would creep. Friction takes the crept distance, the drift, back. The load shows where the friction cone limits it.
/// The bound corrects ODE's direct solver at that limit: it uses normal forces computed without friction.
class ContactHistory {
 public:
  static std::size_t size_of(const multibody::RobotModel& model);

  explicit ContactHistory(std::span<double> memory) : memory_(memory) {}
  void clear() { memory_[0] = 0; }
  /// Gives the contact the data of the nearest stored point of its pair of shapes. Each stored point is used once.
  void recall(FoundContact& contact);
  /// Forgets all points; the points that follow are stored.
  void begin() { stored_ = 0, memory_[0] = 0; }
  /// Stores a contact. `next_point`: its position in the next step.
  void store(const FoundContact& contact, const Vec3& next_point);

 private:
  static constexpr std::size_t numbers = 12;  ///< values of a point: pair, point, drift, load, pressure, bound

  std::span<double> memory_;  ///< points, up to the first without a pair
  std::size_t stored_ = 0;
};

}  // namespace muro::ode
