// SPDX-License-Identifier: MIT
// Kinematics of the leg against those of the model, and its inverse against itself.
#include "leg.hpp"

#include <gtest/gtest.h>

#include <iomanip>
#include <random>
#include <sstream>

#include "settings.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

using namespace walking;

std::vector<double> defaults() {
  std::vector<double> values;
  for (const muro_tunable& t : tunable_table) values.push_back(t.default_value);
  return values;
}

/// Returns a number with all digits.
std::string in_full(double value) {
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

double difference(const Frame& a, const Frame& b) {
  return std::max({(a.origin - b.origin).norm(), (a.rotation.x - b.rotation.x).norm(),
                   (a.rotation.y - b.rotation.y).norm(), (a.rotation.z - b.rotation.z).norm()});
}

/// Returns angles within ranges of the humanoid in which the hip is above the sole.
LegAngles random_angles(std::mt19937& random) {
  const auto between = [&](double from, double to) { return std::uniform_real_distribution<>(from, to)(random); };
  return {between(-0.6, 0.6), between(-0.5, 0.5), between(-1.2, 0.4),
          between(0.05, 1.8), between(-1, 0.6),   between(-0.5, 0.5)};
}

TEST(Leg, SolesAreWhereTheModelHasThem) {
  const Settings settings(defaults().data(), 0.008);
  const Body body(settings.body);
  std::mt19937 random(1);
  const char* const names[] = {"hip_yaw", "hip_roll", "hip_pitch", "knee", "ank_pitch", "ank_roll"};
  for (int k = 0; k < 10; ++k) {
    const BothLegs q{random_angles(random), random_angles(random)};
    std::vector<std::string> overrides{"robots.walker.motion={use: motion.point, rate: 100}", "robots.walker.walk=off",
                                       "robots.walker.links={use: kinematics.direct, rate: 100}"};
    for (const Side side : {left_side, right_side})
      for (std::size_t j = 0; j < leg_joints; ++j)
        overrides.push_back(std::string("robots.walker.joints.") + (side == left_side ? "l_" : "r_") + names[j] + "=" +
                            in_full(q[side][j]));
    Walker walker(overrides);
    walker.simulation().run_for(0.02);
    const Pose base = walker.pose();
    for (const Side side : {left_side, right_side}) {
      const Pose sole = walker.world().value(side == left_side ? "walker/l_sole" : "walker/r_sole", keys::pose);
      const Vec3 origin = base.orientation.conjugate() * (sole.position - base.position);
      const Quat turn = base.orientation.conjugate() * sole.orientation;
      const Frame own = body.leg(side).sole_at(q[side]);
      const Vector &x = own.rotation.x, &z = own.rotation.z;
      EXPECT_LT((origin - Vec3(own.origin.x, own.origin.y, own.origin.z)).norm(), 1e-12);
      EXPECT_LT((turn * Vec3::UnitX() - Vec3(x.x, x.y, x.z)).norm(), 1e-12);
      EXPECT_LT((turn * Vec3::UnitZ() - Vec3(z.x, z.y, z.z)).norm(), 1e-12);
    }
  }
}

TEST(Leg, AnglesPutTheSoleWhereItIsAsked) {
  const LegDimensions bent{.hip = {0.01, 0.04, -0.05},
                           .hip_pitch_x = 0.02,
                           .hip_pitch_z = -0.01,
                           .leg_y = 0.012,
                           .thigh = 0.15,
                           .knee_x = 0.01,
                           .shin = 0.13,
                           .ankle_x = -0.005,
                           .ankle_z = 0.008,
                           .sole_x = 0.01,
                           .sole_y = -0.004,
                           .sole_z = 0.04};
  const Settings settings(defaults().data(), 0.008);
  std::mt19937 random(2);
  for (const LegDimensions& d : {settings.body.leg, bent}) {
    for (int k = 0; k < 1000; ++k) {
      const Leg leg(d, k % 2 == 0 ? 1 : -1);
      const LegAngles q = random_angles(random);
      const LegAngles found = leg.angles_for(leg.sole_at(q));
      EXPECT_LT(difference(leg.sole_at(found), leg.sole_at(q)), 1e-12);
      EXPECT_GT(found[knee], -0.2) << "the knee is ahead";
    }
  }
}

TEST(Leg, PointsToWhatIsOutOfReach) {
  const Leg leg({.hip = {0, 0.04, 0}, .thigh = 0.1, .shin = 0.1, .sole_z = 0.03}, 1);
  const LegAngles q = leg.angles_for({{}, {0.3, 0.04, -0.43}});
  EXPECT_EQ(q[knee], 0);
  EXPECT_NEAR(q[hip_pitch], -std::atan2(0.3, 0.4), 1e-12);
}

}  // namespace
}  // namespace muro::walk_test
