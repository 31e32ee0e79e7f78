// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::mujoco {

/// What a world of MuJoCo is set to (MuJoCo documentation, chapters Computation and XML reference).
struct MujocoSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  int solver = 2;                ///< mjtSolver
  int iterations = 100;          ///< at most, of the solver
  double tolerance = 1e-8;       ///< of the solver
  double time_constant = 0.02;   ///< s: overlap decays by e in it
  double impedance = 0.95;       ///< of contacts, MuJoCo's d: what part of its demand a constraint gets
  double friction_ratio = 500;   ///< impratio: by how much friction is harder than the normal direction
  int refinements = 2;           ///< solutions of a step beyond the first, at most
  double correcting_speed = 1;   ///< m/s: bodies that overlap are parted no faster
  double bounce_speed = 0.02;    ///< m/s: slower impacts do not rebound
  bool exact_attitude = false;   ///< of robots of one body: their free rotation is not left to MuJoCo
  bool several_contacts = true;  ///< mjENBL_MULTICCD
};

}  // namespace muro::mujoco
