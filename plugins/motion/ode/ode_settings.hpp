// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"

namespace muro::ode {

/// What a world of ODE is set to (ODE manual, sections 3.7 and 5).
struct OdeSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  bool exact = false;           ///< dWorldStep instead of dWorldQuickStep
  int iterations = 50;          ///< of dWorldQuickStep
  double erp = 0.2;             ///< part of a joint's or contact's error that a step takes back
  double cfm = 1e-6;            ///< softness of contacts and joints, 1/(N s/m)
  double correcting_speed = 1;  ///< m/s: bodies that overlap are parted no faster
  double bounce_speed = 0.02;   ///< m/s: slower impacts do not rebound
  bool reactions = true;        ///< whether what joints and contacts do is found out
};

}  // namespace muro::ode
