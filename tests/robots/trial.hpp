// SPDX-License-Identifier: MIT
// One robot from a file, moved by one motion over a plane: what is seen of it.
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
  bool passive = false;  ///< nothing drives a joint; else they are in their default mode, with zero velocity targets
  double duration = 2;   ///< s
  std::map<std::string, ParameterInput> more{};  ///< parameters; those that the motion does not have are left out
  double clearance = 0.05;                       ///< m, above the plane at the start
};

/// What the joint of one link did.
struct JointObservation {
  std::string name;
  bool follows = false;  ///< another joint
  double moved = 0;      ///< rad or m, at the end from the start
  double speed = 0;      ///< rad/s or m/s, at the end
};

struct Observations {
  std::string refused;         ///< why the robot was not taken; all else is 0 then
  std::string failure;         ///< why the run ended early, or what was not finite
  double norm_error = 0;       ///< largest | |orientation| - 1 |
  double limit_violation = 0;  ///< rad or m, farthest of a joint outside of its limits
  std::string violating_joint;
  double mimic_error = 0;       ///< rad or m, farthest of a mimic joint from where its leader puts it, at the end
  double lowest = 0;            ///< m, lowest point of all collision shapes at the end; infinite without shapes
  double deepest = 0;           ///< m, the same in the whole run, so at the impact
  double fall = 0;              ///< m, of the base
  double height = 0;            ///< m, of the base at the end
  double tilt = 0;              ///< rad, of the base at the end against the start
  double speed = 0;             ///< m/s, of the origin of the base at the end
  double energy_scale = 0;      ///< J, mass times gravity times 1 m
  double energy_gain = 0;       ///< J, most that kinetic and potential energy together were above those of the start
  double late_energy_gain = 0;  ///< J, the same against the middle of the run, in its second half
  std::vector<JointObservation> joints{};
};

/// Puts the robot above a plane, joints as near to 0 as limits allow, and runs it at 1000 Hz.
Observations run(const TrialSettings& settings);

/// Motions in which forces and contacts move robots, by id.
std::vector<std::string> motions();
Features features_of(const std::string& motion);

/// .urdf files in a folder and below, in order.
std::vector<std::string> descriptions_below(const std::string& folder);

}  // namespace muro::robots
