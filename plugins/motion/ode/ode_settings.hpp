// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::ode {

/// What a world of ODE is set to (ODE manual, sections 3.7 and 5).
struct OdeSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  bool exact = false;           ///< dWorldStep instead of dWorldQuickStep
  int iterations = 50;          ///< of dWorldQuickStep
  double erp = 0.2;             ///< part of a joint's or contact's error that a step takes back
  double softness = 1e-4;       ///< of contacts and joints, as part of the inverse effective mass of each
  double cfm = 0;               ///< softness beyond that, 1/(N s/m): alike for all masses
  double correcting_speed = 1;  ///< m/s: bodies that overlap are parted no faster
  double bounce_speed = 0.02;   ///< m/s: slower impacts do not rebound
  bool exact_attitude = false;  ///< of robots of one body: their free rotation is not left to ODE
  bool reactions = true;        ///< whether what joints and contacts do is found out
};

}  // namespace muro::ode
