// SPDX-License-Identifier: MIT
// One robot from a file, moved by one motion over a plane, and observations of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "muro/features.hpp"

namespace muro::robots {

struct TrialSettings {
  std::string file;      ///< .urdf
  std::string motion;    ///< "motion.ode"
  bool fixed = false;    ///< the base
  bool passive = false;  ///< no joint is driven; else joints are in their default mode, with zero velocity targets
  double duration = 2;   ///< s
  std::map<std::string, ParameterInput> more{};  ///< parameters; those that the motion does not have are left out
  double clearance = 0.05;                       ///< m, above the plane at the start
};

/// Observation of the joint of one link.
struct JointObservation {
  std::string name;
  bool follows = false;  ///< whether it follows another joint
  double moved = 0;      ///< rad or m, at the end from the start
  double speed = 0;      ///< rad/s or m/s, at the end
};

struct Observations {
  std::string refused;         ///< why the robot was refused; all else is 0 then
  std::string failure;         ///< why the run ended early, or what was not finite
  double norm_error = 0;       ///< largest | |orientation| - 1 |
  double limit_violation = 0;  ///< rad or m, largest distance of a joint beyond its limits
  std::string violating_joint;
  double mimic_error = 0;       ///< rad or m, largest error of a mimic joint relative to its leader, at the end
  double lowest = 0;            ///< m, lowest point of all collision shapes at the end; infinite without shapes
  double deepest = 0;           ///< m, lowest point in the whole run, so at the impact
  double fall = 0;              ///< m, of the base
  double height = 0;            ///< m, of the base at the end
  double tilt = 0;              ///< rad, of the base at the end relative to the start
  double speed = 0;             ///< m/s, of the origin of the base at the end
  double energy_scale = 0;      ///< J, mass times gravity times 1 m
  double energy_gain = 0;       ///< J, largest excess of kinetic and potential energy over that of the start
  double late_energy_gain = 0;  ///< J, excess over the energy in the middle of the run, in its second half
  std::vector<JointObservation> joints{};
};

/// Puts the robot above a plane, joints as near to 0 as limits allow, and runs it at 1000 Hz.
Observations run(const TrialSettings& settings);

/// Returns the motions in which forces and contacts move robots, by id.
std::vector<std::string> motions();
Features features_of(const std::string& motion);

/// Returns the .urdf files in a folder and below, in order.
std::vector<std::string> descriptions_below(const std::string& folder);

}  // namespace muro::robots
