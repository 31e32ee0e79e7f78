// SPDX-License-Identifier: MIT
#include "tests/robots/expectations.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

namespace muro::robots {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<Expectation>& all() {
  static const std::vector<Expectation> table = {
      {.robot = "balancer", .end = End::topples},
      {.robot = "crane", .end = End::topples},  // its foundation stands on the ground and is not fixed to it
      {.robot = "ghost", .end = End::falls},
      {.robot = "limits", .without_effort = {"no_effort"}},
      {.robot = "meshes", .on_meshes = true},
      // Its calves cannot be straight, so its rear feet are 3 cm behind its centre of mass: the impact makes it fall.
      {.robot = "quadruped_a1", .end = End::topples},
      {.robot = "rope", .end = End::balances, .long_chain = true},
      {.robot = "scales", .hold = 0.2},  // 0.01 N m against whiskers on a boom that stops from 1 m/s
      {.robot = "scara", .end = End::topples},
      {.robot = "snake", .long_chain = true},
  };
  return table;
}

/// Names and bounds in the order of Check.
constexpr std::array<std::pair<std::string_view, double>, 9> default_bounds = {{
    {"below the ground at the end", 2e-3},
    {"below the ground at an impact", 0.01},
    {"outside of joint limits",
     5e-3},                   // the way in a step at 5 rad/s or m/s: a stop acts from the step on that meets it
    {"energy gained", 2e-3},  // velocities of semi-implicit Euler are older by half a step: v h / 2
    {"mimic joints apart from their leader", 0.01},
    {"driven joints moved", 0.05},  // by the impact, which is more than drives hold: they hold speeds, not positions
    {"moving at the end", 0.02},
    {"height unlike what it should be", 5e-3},
    {"base tilted", 0.05},
}};

constexpr std::string_view own_springs =
    "motion.simplified: with joints that forces move, each link stands on springs that fit its own mass, not what it "
    "carries, and joints answer to a contact as if each were alone";
constexpr std::string_view soft_links =
    "motion.mujoco: a contact is as soft as the mass of the two that touch makes it";

struct Exception {
  Check check;
  std::string_view variant, robot;
  double max;
  std::string_view why;
};
constexpr Exception exceptions[] = {
    {Check::ground, "simplified", "arm", 0.012, own_springs},
    {Check::impact, "simplified", "arm", 0.02, own_springs},
    {Check::ground, "simplified", "biped", 0.012, own_springs},
    {Check::impact, "simplified", "biped", 0.05, own_springs},
    {Check::ground, "simplified", "quadruped", 0.012, own_springs},
    {Check::impact, "simplified", "quadruped", 0.04, own_springs},
    {Check::impact, "simplified", "quadruped_a1", 0.02, own_springs},
    {Check::ground, "simplified", "humanoid", 0.004, own_springs},
    {Check::impact, "simplified", "humanoid", 0.03, own_springs},
    {Check::energy, "simplified", "humanoid", 0.006, own_springs},
    {Check::ground, "simplified", "lander", 0.012, own_springs},
    {Check::impact, "simplified", "lander", 0.03, own_springs},
    {Check::impact, "simplified", "scales", 0.02, own_springs},
    {Check::ground, "simplified", "snake", 0.1, own_springs},
    {Check::impact, "simplified", "snake", 0.11, own_springs},
    {Check::energy, "simplified", "snake", infinity, own_springs},
    {Check::ground, "simplified", "rope", 0.06, own_springs},
    {Check::impact, "simplified", "rope", 0.06, own_springs},
    {Check::energy, "simplified", "rope", infinity, own_springs},
    {Check::ground, "mujoco", "lander", 0.006, soft_links},
    {Check::height, "mujoco", "lander", 0.009, soft_links},
    {Check::limits, "ode", "scales", 0.04, "whiskers of 1e-7 kg m^2 reach their stops with 20 rad/s and more"},
    {Check::limits, "articulated", "scales", 0.015,
     "whiskers of 0.1 g between the ground and their stops take more than the trials of a step: 5 rad/s pass a "
     "stop for two or three steps"},
    {Check::impact, "articulated", "scales", 0.015, "the whip of a whisker of 0.1 g: 12 m/s, 12 mm in a step"},
    {Check::tilt, "ode_quick", "humanoid", infinity, "it falls over by what 50 iterations leave; 200 hold it"},
    {Check::rest, "ode_quick", "caster_base", 0.025, "its casters turn while 50 iterations hold it on its wheels"},
    {Check::ground, "ode_quick", "lander", 0.06, "its legs sink in by what 50 iterations leave"},
    {Check::hold, "articulated", "crane", 0.07, "it topples, and its hoist takes the impact"},
    {Check::hold, "bullet", "rope", 0.13, "it falls over, and its rings take the impact"},
    {Check::rest, "bullet", "scara", 0.03, "its base shakes under its arm, and friction of what spins gives way"},
    {Check::rest, "bullet", "forklift", 0.05, "its rear wheel creeps by 2 mm/s under 2 t"},
    {Check::hold, "bullet", "biped", 0.4, "it leans, and its ankles turn by 0.15 rad/s"},
    {Check::rest, "bullet", "biped", 0.4, "it leans, and its ankles turn by 0.15 rad/s"},
    {Check::tilt, "bullet", "biped", 0.25, "it leans, and its ankles turn by 0.15 rad/s"},
    {Check::height, "bullet", "biped", 0.02, "it leans, and its ankles turn by 0.15 rad/s"},
};

/// Robots for which 50 iterations of motion.ode's solver `quick` are enough. With this solver others are checked only
/// for faults that must never happen; all other checks use the default, which is `exact` for them.
constexpr std::string_view quick_serves[] = {"arm",     "balancer", "caster_base", "dual_arm",  "ghost", "kiwi",
                                             "mecanum", "meshes",   "pendulum",    "quadrotor", "rover"};
constexpr std::string_view not_converged = "50 iterations of the solver `quick` do not converge; use `exact`";

double of_quick(Check check) {
  switch (check) {
    case Check::ground:
      return 0.012;
    case Check::impact:
      return 0.06;
    case Check::tilt:
      return 0.25;
    default:
      return infinity;
  }
}

}  // namespace

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const std::string& motion : motions()) {
    const std::string name = motion.substr(motion.find('.') + 1);
    all.push_back({name, motion, {}});
    if (name == "ode") all.push_back({"ode_quick", motion, {{"solver", std::string("quick")}}});
  }
  return all;
}

Expectation expectation_of(const std::string& robot) {
  for (const Expectation& s : all())
    if (s.robot == robot) return s;
  Expectation usual;
  usual.robot = robot;
  return usual;
}

Bound bound_of(Check check, const std::string& variant, const std::string& robot) {
  for (const Exception& e : exceptions)
    if (e.check == check && e.variant == variant && e.robot == robot) return {e.max, e.why};
  if (variant == "ode_quick" &&
      std::find(std::begin(quick_serves), std::end(quick_serves), robot) == std::end(quick_serves))
    return {of_quick(check), not_converged};
  const double max = default_bounds[std::size_t(check)].second;
  if (check == Check::hold) return {std::max(max, expectation_of(robot).hold), {}};
  return {max, {}};
}

std::string_view name_of(Check check) { return default_bounds[std::size_t(check)].first; }

std::string_view refusal_of(const std::string& variant, const std::string& robot, bool passive) {
  if (variant == "simplified" && robot == "traps" && passive) return "joint `robot/tip_joint` moves an inertia of 0";
  return {};
}

std::string robot_of(const std::string& file) { return std::filesystem::path(file).stem(); }

}  // namespace muro::robots
