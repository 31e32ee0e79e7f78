// SPDX-License-Identifier: MIT
// quadruped_a1.urdf against the data of Unitree A1, and standing on its feet.
#include <gtest/gtest.h>

#include "examples/models/stand_testing.hpp"

namespace muro::models {
namespace {

const std::string standing =
    "joints: {FR_thigh_joint: 0.67, FL_thigh_joint: 0.67, RR_thigh_joint: 0.67, RL_thigh_joint: 0.67, FR_calf_joint: "
    "-1.3, FL_calf_joint: -1.3, RR_calf_joint: -1.3, RL_calf_joint: -1.3}";

TEST(QuadrupedOfA1sClass, HasTheNumbersOfA1) {
  const host::BuiltScenario b = built("quadruped_a1.urdf", standing);
  const auto is = [&](const std::string& body, double mass, const Vec3& moments) {
    SCOPED_TRACE(body);
    const Inertia i = inertia_of(b, body);
    EXPECT_NEAR(i.mass, mass, 1e-12);
    EXPECT_LT((Vec3(i.ixx, i.iyy, i.izz) - moments).norm(), 1e-9);
    EXPECT_TRUE(is_possible(i));
  };
  is("base_link", 6, {0.0159, 0.0378, 0.0457});
  const double degree = M_PI / 180;
  for (const auto& [leg, x, y] : {std::tuple{"FR", 1, -1}, {"FL", 1, 1}, {"RR", -1, -1}, {"RL", -1, 1}}) {
    const std::string name = leg;
    EXPECT_NEAR(inertia_of(b, name + "_hip").mass, 0.595, 1e-12);
    EXPECT_TRUE(is_possible(inertia_of(b, name + "_hip")));
    is(name + "_thigh", 0.888, {5.25e-3, 5.00e-3, 1.11e-3});
    is(name + "_calf", 0.151, {2.34e-3, 2.36e-3, 0.03e-3});
    is(name + "_foot", 0.06, Vec3::Constant(0.4 * 0.06 * 0.02 * 0.02));
    const Link &hip = link_of(b, name + "_hip"), &thigh = link_of(b, name + "_thigh"),
               &calf = link_of(b, name + "_calf");
    EXPECT_LT((hip.origin.position - Vec3(x * 0.1805, y * 0.047, 0)).norm(), 1e-12);
    EXPECT_LT((thigh.origin.position - Vec3(0, y * 0.0838, 0)).norm(), 1e-12);
    EXPECT_LT((calf.origin.position - Vec3(0, 0, -0.2)).norm(), 1e-12);
    EXPECT_LT((link_of(b, name + "_foot").origin.position - Vec3(0, 0, -0.2)).norm(), 1e-12);
    const std::tuple<const Link*, double, double, Vec3> joints[] = {
        {&hip, -46, 46, Vec3::UnitX()}, {&thigh, -60, 240, Vec3::UnitY()}, {&calf, -154.5, -52.5, Vec3::UnitY()}};
    for (const auto& [link, low, high, axis] : joints) {
      EXPECT_NEAR(link->limits.lower, low * degree, 1e-8);
      EXPECT_NEAR(link->limits.upper, high * degree, 1e-8);
      EXPECT_EQ(link->axis, axis);
      EXPECT_EQ(link->limits.effort, 33.5);
      EXPECT_EQ(link->limits.velocity, 21);
    }
  }
  EXPECT_NEAR(mass_of(b), 12.776, 1e-12);
}

TEST(QuadrupedOfA1sClass, StandsInEveryMotionByForces) {
  for (const auto& [motion, seconds] :
       {std::pair{"motion.simplified", 2.0}, {"motion.bullet", 1}, {"motion.mujoco", 2}, {"motion.ode", 0.5}}) {
    host::BuiltScenario b = built("quadruped_a1.urdf", standing + ", motion: {use: " + motion +
                                                           ", joints: position, stiffness: 300, damping: 8}");
    EXPECT_TRUE(stands(b, seconds)) << motion;
  }
}

TEST(QuadrupedOfA1sClass, FallsWhenItsMotorsAreOff) {
  for (const char* motion : {"motion.simplified", "motion.bullet", "motion.mujoco", "motion.ode"}) {
    host::BuiltScenario b = built("quadruped_a1.urdf", standing + ", motion: {use: " + motion + ", joints: passive}");
    EXPECT_FALSE(stands(b, 0.6, 0.05)) << motion;
  }
}

}  // namespace
}  // namespace muro::models
