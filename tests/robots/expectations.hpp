// SPDX-License-Identifier: MIT
// What every robot should do, and where a motion is allowed to do worse, and why.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/robots/trial.hpp"

namespace muro::robots {

/// A motion with parameters of its own.
struct Variant {
  std::string name;  ///< "ode_exact"
  std::string motion;
  std::map<std::string, ParameterInput> more;
};
/// Every motion in which forces and contacts move robots; motion.ode with both of its solvers.
std::vector<Variant> variants();

/// How a robot ends that is put down with its base free and its drives holding.
enum class End {
  stands,    ///< upright on what it was put on
  topples,   ///< it falls over, and lies
  falls,     ///< nothing stops it
  balances,  ///< on its tip: nobody can say for how long
};

struct Expectation {
  std::string_view robot;
  End end = End::stands;
  std::vector<std::string_view> without_effort{};  ///< joints that their drives cannot hold
  bool on_meshes = false;                          ///< meshes bear it: it sinks by them where they collide with nothing
  double hold = 0;          ///< rad or m: what the impact turns its joints by, where that is much
  bool long_chain = false;  ///< no number of iterations that a test may take holds it
};
/// Of robots that are not listed: all of the default.
Expectation expectation_of(const std::string& robot);

/// What is measured in each run.
enum class Check {
  ground,  ///< m, below the plane at the end
  impact,  ///< m, the same at any time
  limits,  ///< rad or m, of joints outside of their limits
  energy,  ///< m: what the passive robot gains, as height of its whole mass
  mimic,   ///< rad or m, of mimic joints from where their leader puts them at the end
  hold,    ///< rad or m, by which driven joints move
  rest,    ///< m/s or rad/s at the end
  height,  ///< m, of the base at the end from where it should stand, and from motion to motion
  tilt,    ///< rad, of a base that stands
};
struct Bound {
  double max = 0;
  std::string_view why;
};
/// That of every robot, or its own where it has one with a reason.
Bound bound_of(Check check, const std::string& variant, const std::string& robot);
std::string_view name_of(Check check);

/// Words that the refusal of a robot has, where a variant refuses it in this mode; empty: it takes the robot.
std::string_view refusal_of(const std::string& variant, const std::string& robot, bool passive);

/// "rover", of a path.
std::string robot_of(const std::string& file);

}  // namespace muro::robots
