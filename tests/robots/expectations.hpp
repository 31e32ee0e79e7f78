// SPDX-License-Identifier: MIT
// Expected results for every robot, and where and why a motion may give worse ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/robots/trial.hpp"

namespace muro::robots {

/// A motion with certain parameters.
struct Variant {
  std::string name;  ///< "ode_exact"
  std::string motion;
  std::map<std::string, ParameterInput> more;
};
/// Returns every motion in which forces and contacts move robots; motion.ode with both of its solvers.
std::vector<Variant> variants();

/// Final state of a robot that is put down with its base free and its drives holding.
enum class End {
  stands,    ///< upright on what it was put on
  topples,   ///< it has fallen over and lies
  falls,     ///< nothing stops its fall
  balances,  ///< on its tip, for an unknown time
};

struct Expectation {
  std::string_view robot;
  End end = End::stands;
  std::vector<std::string_view> without_effort{};  ///< joints that their drives cannot hold
  bool on_meshes = false;                          ///< it stands on meshes: it sinks if meshes do not collide
  double hold = 0;                                 ///< rad or m: rotation of its joints by the impact, if that is large
  bool long_chain = false;                         ///< too long for any number of iterations that a test can afford
};
/// Returns the expectation of a robot. Robots that are not listed have all defaults.
Expectation expectation_of(const std::string& robot);

/// Quantities measured in each run.
enum class Check {
  ground,  ///< m, below the plane at the end
  impact,  ///< m, below the plane at any time
  limits,  ///< rad or m, of joints outside of their limits
  energy,  ///< m: energy gain of the passive robot, as height of its whole mass
  mimic,   ///< rad or m, of mimic joints from their positions by the leader at the end
  hold,    ///< rad or m, by which driven joints move
  rest,    ///< m/s or rad/s at the end
  height,  ///< m, of the base at the end from its standing height, and from motion to motion
  tilt,    ///< rad, of a base that stands
};
struct Bound {
  double max = 0;
  std::string_view why;
};
/// Returns the bound of every robot, or that of this robot if it has one with a reason.
Bound bound_of(Check check, const std::string& variant, const std::string& robot);
std::string_view name_of(Check check);

/// Returns words in the message with which a variant refuses a robot in this mode, or "" if it accepts the robot.
std::string_view refusal_of(const std::string& variant, const std::string& robot, bool passive);

/// Returns a name such as "rover" from a path.
std::string robot_of(const std::string& file);

}  // namespace muro::robots
