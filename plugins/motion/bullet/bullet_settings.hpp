// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::bullet {

/// What a world of Bullet is set to.
struct BulletSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  int iterations = 10;          ///< of the solver
  double erp = 0.2;             ///< part of a depth or of a passed limit that a step takes back
  double cfm = 0;               ///< s/kg: softness of contacts
  double slop = 1e-4;           ///< m: depth that is not taken back
  double correcting_speed = 1;  ///< m/s: bodies that overlap are parted no faster
  double bounce_speed = 0.02;   ///< m/s: slower impacts do not rebound
  double warm_start = 1;        ///< part of the last step's impulses that the solver begins with
};

}  // namespace muro::bullet
