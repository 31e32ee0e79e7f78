// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::bullet {

/// Settings of a world of Bullet.
struct BulletSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  int iterations = 10;          ///< iterations of the solver
  double erp = 0.2;             ///< part of a depth or of an exceeded limit that a step corrects
  double cfm = 0;               ///< s/kg: softness of contacts
  double slop = 1e-4;           ///< m: depth that is not corrected
  double correcting_speed = 1;  ///< m/s: largest speed at which overlapping bodies are separated
  double bounce_speed = 0.02;   ///< m/s: slower impacts do not rebound
  double warm_start = 1;        ///< part of the last step's impulses that the solver begins with
};

}  // namespace muro::bullet
