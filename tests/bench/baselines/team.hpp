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
  /// Sets the speeds that the drives of a vehicle's wheels hold from now on.
  virtual void command(int vehicle, WheelSpeeds speeds) = 0;
  virtual void run(int milliseconds) = 0;
  /// Returns the pose of the chassis' centre.
  virtual Pose pose(int vehicle) const = 0;
};

/// Settings of an engine's solver, for each simulated millisecond.
struct SolverSettings {
  int steps = 1;
  int iterations = 4;  ///< of each step, if the engine iterates
  /// Many more than needed, so that neither number limits the solution of the engine's equations.
  static constexpr SolverSettings converged() { return {4, 200}; }
};

/// An engine, or one way to use it.
struct Engine {
  std::string name;
  bool one_body = false;  ///< a vehicle is one rigid body; otherwise its wheels are bodies of their own
  std::function<std::unique_ptr<Team>(const City&, SolverSettings)> make;
  SolverSettings settings{};  ///< of the measurement
  int teams = 1;              ///< number of teams at once, each on its own thread
};

/// Returns the engines that the build has found.
std::vector<Engine> baselines();

std::unique_ptr<Team> bullet_raycast_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> bullet_rigid_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> ode_one_body_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> ode_articulated_vehicles(const City& city, SolverSettings settings);
std::unique_ptr<Team> mujoco_vehicles(const City& city, SolverSettings settings);

}  // namespace muro::bench
