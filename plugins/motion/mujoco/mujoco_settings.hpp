// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::mujoco {

/// Settings of a world of MuJoCo (MuJoCo documentation, chapters Computation and XML reference).
struct MujocoSettings {
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  FrictionRule friction_rule = FrictionRule::min;
  int solver = 2;                ///< mjtSolver
  int iterations = 100;          ///< largest number of solver iterations
  double tolerance = 1e-8;       ///< of the solver
  double time_constant = 0.02;   ///< s: time in which an overlap decays by e
  double impedance = 0.95;       ///< MuJoCo's d of contacts: part of its demand that a constraint gets
  double friction_ratio = 500;   ///< impratio: stiffness of friction over that of the normal direction
  int refinements = 2;           ///< largest number of solutions of a step after the first
  double correcting_speed = 1;   ///< m/s: largest speed at which overlapping bodies are separated
  double bounce_speed = 0.02;    ///< m/s: slower impacts do not rebound
  bool exact_attitude = false;   ///< robots of one body: their free rotation is not computed by MuJoCo
  bool several_contacts = true;  ///< mjENBL_MULTICCD
};

}  // namespace muro::mujoco
