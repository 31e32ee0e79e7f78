// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/scene.hpp"

namespace muro::host {

/// Sees from outside who touches whom, in the same way for all motions.
///
/// Engines tell of contacts in ways that cannot be compared: a list of points, the sum of forces on a body, nothing. So
/// the bodies and the scenery of the scene that is watched stand once more in a scene of their own, where now and then
/// they are put where they are, and collision detection finds which of them meet. Ground does not count: planes, and
/// what a robot touches at the first look.
class Witness {
 public:
  static constexpr std::int64_t period = 10'000'000;  ///< ns between looks
  static constexpr double reach = 0.001;              ///< m: who is nearer touches
  static constexpr double pause = 0.1;                ///< s: who has been apart for longer touches anew

  /// For contacts of those of `robots` (numbers) that forces move. `algorithms`: of the scenario; collision detection
  /// and index are taken from there, or are the default ones. Throws SetupError where there are none.
  Witness(Simulation& watched, const std::vector<std::uint32_t>& robots, const std::vector<Subsystem>& algorithms);

  /// To be called every `period`.
  void look();

  /// Whether there is a robot whose contacts count.
  bool counts() const { return any_; }
  std::size_t begins() const { return begins_; }                ///< of contacts, by pairs of things
  std::optional<double> first_begin() const { return first_; }  ///< s

 private:
  /// Number of a robot and what it touches: another robot, or an object of the scenery.
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct Body {
    std::uint32_t robot;
    const Pose* from;
    Pose* to = nullptr;
  };

  void add_scenery();
  void add_bodies();
  Shape shape_of(Shape shape, double more);
  void use_collision(const std::vector<Subsystem>& algorithms);
  void meet(std::uint32_t body, const Contact& contact, double now);
  void touch(const Pair& pair, double now);

  Simulation& watched_;
  Simulation scene_;
  std::vector<TaskId> tasks_;
  std::vector<bool> counted_;  ///< by number of the robot
  bool any_ = false;
  std::vector<Body> bodies_;     ///< by number of the robot that stands for it
  std::map<Pair, double> seen_;  ///< s, last
  std::set<Pair> stands_;
  bool looked_ = false;
  std::size_t begins_ = 0;
  std::optional<double> first_;
};

}  // namespace muro::host
