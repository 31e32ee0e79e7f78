// SPDX-License-Identifier: MIT
// Flying robots keep their momenta, whatever their joints do; a pendulum has the period of its closed form.
#include <cmath>

#include "articulated_testing.hpp"

namespace muro::articulated::testing {
namespace {

TEST(ATreeInFlight, KeepsItsMomentaWhileItsJointsAreDriven) {
  World w;
  w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotTree humanoid = w.read_model(MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf");
  const RobotView& r = w.add("r", humanoid, {{1, 2, 3}, Quat::Identity()}, {{0.5, -0.3, 0.2}, {1, -2, 3}});
  w.start({{"joints", std::string("position")}});
  w.refresh();
  const Motion before = motion_of(w, r);
  double most = 0;
  for (int k = 0; k < 100; ++k) {
    int number = 0;
    for (const Link& link : r.links)
      if (link.joint != JointKind::fixed)
        w.world().value(link.joint_object, keys::joint_position_target) = 0.6 * std::sin(0.35 * k + 1.3 * number++);
    w.run_for(0.1);
    w.refresh();
    const Motion now = motion_of(w, r);
    EXPECT_LT((now.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm()) << k;
    EXPECT_LT((now.angular - before.angular).norm(), 1e-9 * before.angular.norm()) << k;
    most = std::max(most, std::abs(w.q("r/waist_yaw")) + std::abs(w.q("r/r_sho_pitch")));
  }
  EXPECT_GT(most, 0.8) << "rad: its joints move";
}

TEST(ATreeInFlight, KeepsItsMomentaWithPassiveJoints) {
  World w;
  w.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotTree humanoid = w.read_model(MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf");
  const RobotView& r = w.add("r", humanoid, {}, {{0.5, -0.3, 0.2}, {2, -4, 5}});
  w.start({{"joints", std::string("passive")}});
  w.refresh();
  const Motion before = motion_of(w, r);
  for (int k = 0; k < 10; ++k) {
    w.run_for(1);
    w.refresh();
    const Motion now = motion_of(w, r);
    EXPECT_LT((now.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm()) << k;
    EXPECT_LT((now.angular - before.angular).norm(), 1e-9 * before.angular.norm()) << k;
    EXPECT_LE(now.kinetic, before.kinetic * 1.001) << k;
  }
}

/// Returns the complete elliptic integral of the first kind, by the arithmetic-geometric mean.
double elliptic(double modulus) {
  double a = 1, b = std::sqrt(1 - modulus * modulus);
  while (std::abs(a - b) > 1e-15) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b), a = mean;
  }
  return M_PI / (2 * a);
}

/// Returns the mean of the first periods (s) of a rod of 1 m that starts at `amplitude` (rad), from its passages
/// downwards.
double period(double amplitude, double rate) {
  World w;
  w.add("r", test::tree_of([](RobotBuilder& b) {
          b.base("stand");
          b.set(keys::inertial, test::solid_box(5, {0.1, 0.1, 0.1}));
          b.revolute("joint", Vec3::UnitY(), {});
          b.body("rod");
          b.set(keys::inertial, Inertia{.mass = 2, .com = {0, 0, -0.5}, .ixx = 1.0 / 6, .iyy = 1.0 / 6, .izz = 1e-3});
        }));
  w.world().set(w.world().object("r/joint"), keys::initial_joint_position, amplitude);
  w.start({{"joints", std::string("passive")}, {"base", std::string("fixed")}}, rate);
  std::vector<double> passages;
  double before = amplitude;
  for (int k = 1; passages.size() < 4; ++k) {
    w.run_for(1 / rate);
    const double now = w.q("r/joint");
    if (before > 0 && now <= 0) passages.push_back((k - 1 + before / (before - now)) / rate);
    before = now;
  }
  return (passages[3] - passages[0]) / 3;
}

TEST(APendulum, HasThePeriodOfTheEllipticIntegral) {
  const double length = 2.0 / 3;  // m: length of the mathematical pendulum, 2/3 of a rod
  for (const double degrees : {10.0, 90.0, 150.0}) {
    const double amplitude = degrees * M_PI / 180;
    const double expected = 4 * std::sqrt(length / g) * elliptic(std::sin(0.5 * amplitude));
    EXPECT_NEAR(period(amplitude, 1000), expected, 1e-4 * expected) << degrees << " degrees";
  }
}

}  // namespace
}  // namespace muro::articulated::testing
