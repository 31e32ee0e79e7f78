// SPDX-License-Identifier: MIT
// Engines that are less exact than a case requires, and the reasons.
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

struct Exception {
  std::string_view motion, name;
  double error;
  std::string_view why;
};
constexpr Exception exceptions[] = {
    {"motion.mujoco", "a tumbling box keeps its angular momentum", 0.02, "Euler steps of the attitude, first order"},
    {"motion.mujoco", "a tumbling box keeps its energy", 0.02, "Euler steps of the attitude, first order"},
    {"motion.mujoco", "a tumbling box flies a parabola", 0.05, "semi-implicit Euler: g dt t / 2 = 0.049 m"},
    {"motion.mujoco", "a tumbling box turns as Euler's equations say", 0.05,
     "Euler steps of the attitude, first order"},
    {"motion.ode", "a tumbling box keeps its angular momentum", 0.03, "Euler steps of the attitude, first order"},
    {"motion.ode", "a tumbling box keeps its energy", 0.02, "Euler steps of the attitude, first order"},
    {"motion.ode", "a tumbling box flies a parabola", 0.05, "semi-implicit Euler: g dt t / 2 = 0.049 m"},
    {"motion.ode", "a tumbling box turns as Euler's equations say", 0.2, "Euler steps of the attitude, first order"},
    {"motion.mujoco", "an arm of six joints swings as its equations say", 5, "semi-implicit Euler, first order"},
    {"motion.mujoco", "a chain of ten links swings as its equations say", 0.8, "semi-implicit Euler, first order"},
    {"motion.mujoco", "an arm in flight swings as its equations say", 3e-3, "semi-implicit Euler, first order"},
    {"motion.ode", "an arm of six joints swings as its equations say", 0.4, "Euler steps, first order"},
    {"motion.ode", "a chain of ten links swings as its equations say", 0.04, "Euler steps, first order"},
    {"motion.ode", "an arm in flight swings as its equations say", 0.015, "Euler steps, first order"},
    {"motion.simplified", "joints without mass go to their targets at their limits of speed", 2.1e-4,
     "speeds up evenly within its first step: behind by half of it"},
    {"motion.simplified", "joints without mass stop at their limits of position", 2.1e-4,
     "speeds up evenly within its first step: behind by half of it"},
    {"motion.simplified", "joints without mass integrate targets of velocity", 2.1e-4,
     "speeds up evenly within its first step: behind by half of it"},
    {"motion.articulated", "a ball of restitution 0 stays down", 0.04, "at 250 Hz: its contacts are springs"},
    {"motion.articulated", "a ball rebounds by its restitution wherever in a step it lands", 0.08,
     "at 250 Hz: its contacts are springs"},
    {"motion.bullet", "what moving plates squeeze is not thrown", 4.5, "impulses until nothing overlaps"},
    {"motion.mujoco", "what moving plates squeeze is not thrown", 1.5, "harder than springs of 50 Hz"},
    {"motion.ode", "a leader swings with what its mimic carries", 1, "ODE has no constraint between two joints"},
    {"motion.ode", "a leader sags under what its mimic carries", 1, "ODE has no constraint between two joints"},
    {"motion.simplified", "a mesh with a placeholder for its inertia comes to rest on a face", 0.015,
     "contacts fit the least inertia, so its corners sink in as those of a box with it do"},
    {"motion.bullet", "a cart on wheels that are meshes turns with T + s b", 0.009,
     "the facets of a wheel touch one by one"},
    {"motion.mujoco", "a cart on wheels that are meshes turns with T + s b", 0.04,
     "the facets of a wheel touch one by one"},
    {"motion.ode", "a cart on wheels of 3 cm turns with T + s b", 0.008, "its points share the load but roughly"},
    {"motion.ode", "a cart on wheels of 6 cm turns with T + s b", 0.008, "its points share the load but roughly"},
    {"motion.ode", "a cart on wheels that are meshes turns with T + s b", 0.04,
     "the facets of a wheel touch one by one"},
    {"motion.mujoco", "a disc that spins is slowed by its pressure", 0.08,
     "its friction follows the pressure in two steps"},
    {"motion.articulated", "two fingers hold what their friction can carry", 4.5, "its contacts take 10 ms to press"},
    {"motion.simplified", "two fingers hold what their friction can carry", 4.5, "its contacts take 10 ms to press"},
    {"motion.bullet", "a load sinks no deeper into a board of a thousandth", 0.0225,
     "1000 : 1: its solver does not converge, and the load goes through the board"},
    {"motion.mujoco", "a load sinks no deeper into a board of a thousandth", 0.015,
     "1000 : 1: its solver does not converge, and the load goes through the board"},
    {"motion.ode", "a load sinks no deeper into a board of a thousandth", 0.0225,
     "1000 : 1: its solver does not converge, and the load goes through the board"},
    {"motion.bullet", "a finger goes no deeper into a wall that it presses", 2.5e-4,
     "250 Hz: its contacts are as soft as its margin"},
    {"motion.mujoco", "a finger goes no deeper into a wall that it presses", 5e-4, "its constraints are soft"},
    {"motion.bullet", "none of ten boxes in a stack sinks into another", 0.0005,
     "250 Hz: its contacts are as soft as its margin"},
    {"motion.mujoco", "none of ten boxes in a stack sinks into another", 0.0004, "its constraints are soft"},
    {"motion.bullet", "a rover stands on a plank on two bricks", 0.0004,
     "250 Hz: its contacts are as soft as its margin"},
    {"motion.bullet", "feet sink no deeper under a robot that stands on four legs", 0.0004,
     "250 Hz: its contacts are as soft as its margin"},
    {"motion.mujoco", "feet sink no deeper under a robot that stands on four legs", 0.00045,
     "its constraints are soft"},
    {"motion.simplified", "feet sink no deeper under a robot that stands on four legs", 0.006,
     "250 Hz: it learns what its legs press over 5 s, and is 7 mm deep at first; 1 kHz: 0.03 mm"},
    {"motion.mujoco", "a ball with speed to the side rebounds by Coulomb's impulse", 0.045,
     "a soft contact: the lever is shorter by its depth"},
    {"motion.ode", "a ball with speed to the side rebounds by Coulomb's impulse", 0.04,
     "the lever is shorter or longer by the way of a step"},
    {"motion.ode", "a rod strikes with one end by Coulomb's impulse", 0.035,
     "the lever is shorter or longer by the way of a step"},
    {"motion.mujoco", "a rod strikes with one end by Coulomb's impulse", 0.12,
     "a soft contact, which sticks and slides in turn"},
    {"motion.mujoco", "a coin that spins gains no energy", 4e-3, "forces act where bodies touch before the step"},
    {"motion.ode", "a coin that spins gains no energy", 4e-3, "forces act where bodies touch before the step"},
    {"motion.ode", "a tilted cylinder that turns gains no energy", 0.012,
     "forces act where bodies touch before the step"},
    {"motion.bullet", "Euler's disk goes round by sqrt(4 g / (R sin tilt))", 0.15, "it loses energy as it rolls"},
    {"motion.mujoco", "Euler's disk goes round by sqrt(4 g / (R sin tilt))", 0.09,
     "forces act where bodies touch before the step"},
    {"motion.ode", "Euler's disk goes round by sqrt(4 g / (R sin tilt))", 0.09,
     "forces act where bodies touch before the step"},
    {"motion.mujoco", "Euler's disk gains no energy", 0.045, "forces act where bodies touch before the step"},
    {"motion.ode", "boxes that tip over gain no energy", 2.5e-3, "at 250 Hz"},
    {"motion.ode", "Euler's disk gains no energy", 0.012, "forces act where bodies touch before the step"},
    {"motion.ode", "a rover parks on 30 deg when tan is below mu", 1e-3, "50 iterations do not converge"},
};

}  // namespace

Bound bound_of(const std::string& motion, const Case& c) {
  for (const Exception& e : exceptions)
    if (e.motion == motion && e.name == c.name) return {e.error, e.why};
  return {c.bound};
}

}  // namespace muro::conformance
