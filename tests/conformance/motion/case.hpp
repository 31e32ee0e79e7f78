// SPDX-License-Identifier: MIT
// Cases with known answers for every motion that has the features that they need. The tests compare the error of each
// motion with its bound; the benchmark prints the errors.
#pragma once

#include "muro/features.hpp"
#include "tests/support/bodies.hpp"

namespace muro::conformance {

inline constexpr double g = 9.81;  ///< m/s^2

/// A motion under test, in a small scene of its own.
class Trial : public test::Scene {
 public:
  /// Steps at `rate` (Hz).
  explicit Trial(const std::string& motion, double rate = 1000);

  /// Lets the motion move all robots so far, with contacts. Leaves out `parameters` that the motion does not have.
  void start(std::map<std::string, ParameterInput> parameters = {});
  void set_gravity(const Vec3& gravity) { world().set(world_object, keys::gravity, gravity); }
  /// Adds a plane through the origin that rises along x by `angle` (rad).
  void add_slope(double angle, double friction);
  double& joint(std::string_view name, const Key<double>& key) { return world().value(name, key); }

 private:
  std::string motion_;
  double rate_;
};

/// Result of a case.
struct Outcome {
  double error = 0;  ///< compared with the bound
  std::string seen;  ///< the measured value, for people
};

struct Case {
  std::string_view name;  ///< a sentence
  std::string_view unit;  ///< of the error
  Features needs = 0;     ///< features that a motion must have, all of them
  double bound = 0;       ///< of the error
  Outcome (*run)(const std::string& motion) = nullptr;
  std::string_view only_for{};  ///< the only motion that it is for; empty: all that have the features
};

/// Returns all cases, in the order of their table.
std::vector<Case> all_cases();
std::vector<Case> free_body_cases();
std::vector<Case> slope_cases();
std::vector<Case> rolling_cases();
std::vector<Case> impact_cases();
std::vector<Case> load_cases();
std::vector<Case> grip_cases();
std::vector<Case> joint_cases();
std::vector<Case> mimic_joint_cases();
std::vector<Case> massless_arm_cases();
std::vector<Case> position_drive_cases();
std::vector<Case> pendulum_cases();
std::vector<Case> swing_cases();
std::vector<Case> limb_cases();
std::vector<Case> vehicle_cases();
std::vector<Case> commanded_joint_cases();
std::vector<Case> obstacle_cases();
std::vector<Case> mesh_cases();
std::vector<Case> heightmap_cases();
std::vector<Case> tunnelling_cases();
std::vector<Case> patch_cases();
std::vector<Case> passivity_cases();

/// Returns why the case does not apply to the motion; empty if it applies.
std::string why_left_out(const std::string& motion, const Case& c);

/// Largest error of this motion in this case: that of the case, or its own with a reason (see bounds.cpp).
struct Bound {
  double error = 0;
  std::string_view why{};  ///< reason why it is not that of the case; empty if it is
};
Bound bound_of(const std::string& motion, const Case& c);

/// Returns the motions of the build by id, except those of robots with certain parts (test::names_parts).
std::vector<std::string> motions();
const Description& description_of(const std::string& motion);

using test::ball;
using test::block;
using test::solid_box;
using test::solid_cylinder;
using test::with;

std::string text(double x);
/// Returns |seen - expected| / |expected|, with the seen value.
Outcome relative(double seen, double expected);

}  // namespace muro::conformance
