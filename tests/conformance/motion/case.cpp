// SPDX-License-Identifier: MIT
#include "tests/conformance/motion/case.hpp"
#include "muro/detail/names.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/team.hpp"

#include <cstdio>

namespace muro::conformance {

Trial::Trial(const std::string& motion, double rate) : motion_(motion), rate_(rate) {}

void Trial::start(std::map<std::string, ParameterInput> parameters) {
  const Description& d = description_of(motion_);
  std::map<std::string, ParameterInput> of_collision;  // used where the motion does not find its contacts itself
  if (const auto meshes = parameters.find("meshes"); meshes != parameters.end()) of_collision.insert(*meshes);
  for (auto p = parameters.begin(); p != parameters.end();) {
    const bool known =
        std::any_of(d.parameters.begin(), d.parameters.end(), [&](const Parameter& k) { return k.name == p->first; });
    p = known ? std::next(p) : parameters.erase(p);
  }
  use(motion_, rate_, all_robots(), parameters);
  use_contacts({}, of_collision);
  build();
}

void Trial::add_slope(double angle, double friction) { add_ground(friction, {Vec3::Zero(), from_rpy(0, -angle, 0)}); }

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& some :
       {free_body_cases(), slope_cases(),     rolling_cases(),     impact_cases(),          load_cases(),
        grip_cases(),      joint_cases(),     mimic_joint_cases(), position_drive_cases(),  massless_arm_cases(),
        pendulum_cases(),  swing_cases(),     vehicle_cases(),     commanded_joint_cases(), obstacle_cases(),
        mesh_cases(),      heightmap_cases(), tunnelling_cases(),  patch_cases(),           passivity_cases(),
        limb_cases()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::string why_left_out(const std::string& motion, const Case& c) {
  if (!c.only_for.empty() && motion != c.only_for) return "it is for " + std::string(c.only_for);
  const Features has = description_of(motion).features;
  std::string missing;
  for (const FeatureInfo& f : feature_infos)
    if ((c.needs & f.bit) != 0 && (has & f.bit) == 0) missing += (missing.empty() ? "" : ", ") + std::string(f.name);
  return missing.empty() ? "" : "the motion does not offer " + missing;
}

std::vector<std::string> motions() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.kind == "motion" && !test::names_parts(o.id)) ids.push_back(o.id);
  return ids;
}

const Description& description_of(const std::string& motion) { return *test::plugins().algorithm(motion).description; }

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.7g", x);
  return buffer;
}

Outcome relative(double seen, double expected) {
  return {std::abs(seen - expected) / std::abs(expected), text(seen) + " for " + text(expected)};
}

}  // namespace muro::conformance
