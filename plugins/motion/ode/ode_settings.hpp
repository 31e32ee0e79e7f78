// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::ode {

/// Settings of a world of ODE (ODE manual, sections 3.7 and 5).
struct OdeSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  bool exact = false;           ///< dWorldStep instead of dWorldQuickStep
  int iterations = 50;          ///< number of iterations of dWorldQuickStep
  double erp = 0.2;             ///< part of a joint's or contact's error that a step corrects
  double softness = 1e-4;       ///< softness of contacts and joints: part of the inverse effective mass of each
  double cfm = 0;               ///< additional softness, 1/(N s/m): equal for all masses
  double correcting_speed = 1;  ///< m/s: largest speed at which overlapping bodies are separated
  double bounce_speed = 0.02;   ///< m/s: slower impacts do not rebound
  bool exact_attitude = false;  ///< robots of one body: their free rotation is not computed by ODE
  bool reactions = true;        ///< whether forces of joints and contacts are read from ODE
};

}  // namespace muro::ode
