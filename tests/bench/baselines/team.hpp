// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/bench/baselines/city.hpp"

namespace muro::bench {

/// The vehicles of a city in some engine. Nothing ever sleeps.
class Team {
 public:
  virtual ~Team() = default;
  /// What the drives of a vehicle's wheels hold from now on.
  virtual void command(int vehicle, WheelSpeeds speeds) = 0;
  virtual void run(int milliseconds) = 0;
  /// Of the chassis' centre.
  virtual Pose pose(int vehicle) const = 0;
};

/// Settings of an engine's solver, for each simulated millisecond.
struct SolverSettings {
  int steps = 1;
  int iterations = 4;  ///< of each step, if the engine iterates
  /// Many more than needed: the solution of an engine's equations when neither number limits it.
  static constexpr SolverSettings converged() { return {4, 200}; }
};

/// An engine, or one way to use it.
struct Engine {
  std::string name;
  bool one_body = false;  ///< a vehicle is one rigid body; otherwise its wheels are bodies of their own
  std::function<std::unique_ptr<Team>(const City&, SolverSettings)> make;
  SolverSettings settings{};  ///< that it is measured with
  int teams = 1;              ///< so many at once, each on a thread of its own
};

/// The engines that were found when this was built.
std::vector<Engine> baselines();

std::unique_ptr<Team> bullet_raycast_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> bullet_rigid_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> ode_one_body_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> ode_articulated_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> mujoco_vehicles(const City& city, SolverSettings settings);

}  // namespace muro::bench
