// SPDX-License-Identifier: MIT
// Energy and momentum of bodies that move without friction, by both integrators.
#include <gtest/gtest.h>

#include "muro/toolkit/mass_properties.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

constexpr double g = 9.81;
constexpr double upper_length = 0.3;
const Inertia upper{.mass = 0.7, .com = {0, 0, -0.17}, .ixx = 0.004, .iyy = 0.004, .izz = 1e-4};
const Inertia lower{.mass = 0.4, .com = {0, 0, -0.12}, .ixx = 0.002, .iyy = 0.002, .izz = 1e-4};

/// Returns two rods that swing about y, one on the other.
RobotTree double_pendulum(bool is_geared) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("frame");
    b.set(keys::inertial, Inertia{.mass = 3, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    b.revolute("shoulder", Vec3::UnitY(), {});
    b.body("upper");
    b.set(keys::inertial, upper);
    b.translation({0, 0, -upper_length});
    b.revolute("elbow", Vec3::UnitY(), {});
    if (is_geared) b.mimic("shoulder", -1.5, 0.3);
    b.body("lower");
    b.set(keys::inertial, lower);
  });
}

struct DoublePendulum : test::Scene {
  DoublePendulum(const std::string& integrator, double rate, bool is_geared = false) {
    const RobotView& robot = add("r", double_pendulum(is_geared));
    for (const Link& f : robot.links)
      if (f.joint != JointKind::fixed)
        world().set(f.joint_object, keys::initial_joint_position,
                    f.joint_object == robot.links[1].joint_object ? 1.2
                    : is_geared                                   ? -1.5
                                                                  : -0.7);
    use("motion.articulated", rate, all_robots(),
        {{"joints", std::string("passive")}, {"base", std::string("fixed")}, {"integrator", integrator}});
    build();
  }
  /// Returns the energy by Lagrange's equations; angles are from the vertical.
  double energy() {
    const double a = world().value("r/shoulder", keys::joint_position),
                 b = a + world().value("r/elbow", keys::joint_position);
    const double u = world().value("r/shoulder", keys::joint_velocity),
                 w = u + world().value("r/elbow", keys::joint_velocity);
    const double c1 = -upper.com.z(), c2 = -lower.com.z(), l = upper_length;
    const double first = upper.iyy + upper.mass * c1 * c1 + lower.mass * l * l,
                 second = lower.iyy + lower.mass * c2 * c2;
    return 0.5 * (first * u * u + second * w * w) + lower.mass * l * c2 * std::cos(a - b) * u * w -
           g * ((upper.mass * c1 + lower.mass * l) * std::cos(a) + lower.mass * c2 * std::cos(b));
  }
  /// Returns the largest change of the energy within 10 s, relative to the energy of its swing.
  double drift() {
    const double swing = (upper.mass * 0.17 + lower.mass * (upper_length + 0.12)) * g, start = energy();
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      run_for(0.01);
      worst = std::max(worst, std::abs(energy() - start) / swing);
    }
    return worst;
  }
};

TEST(Integrator, RungeAndKuttaKeepTheEnergyOfADoublePendulum) { EXPECT_LT(DoublePendulum("rk4", 1000).drift(), 1e-5); }

TEST(Integrator, TheErrorFallsByFourWhenTheStepHalves) {
  const double coarse = DoublePendulum("semi_implicit", 1000).drift(),
               fine = DoublePendulum("semi_implicit", 2000).drift();
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 3.5);
}

TEST(Integrator, KeepsTheEnergyOfAPendulumWhoseElbowFollows) {
  const double coarse = DoublePendulum("semi_implicit", 1000, true).drift(),
               fine = DoublePendulum("semi_implicit", 2000, true).drift();
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 3.5);
}

TEST(Integrator, RungeAndKuttaAreOfFourthOrderWithMimicJoints) {
  const double coarse = DoublePendulum("rk4", 200, true).drift(), fine = DoublePendulum("rk4", 400, true).drift();
  EXPECT_LT(coarse, 1e-6);
  EXPECT_GT(coarse / fine, 12);
}

}  // namespace
}  // namespace muro
