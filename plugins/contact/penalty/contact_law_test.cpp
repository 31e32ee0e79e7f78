// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "contact_law.hpp"
#include "muro/geometry.hpp"
#include "restitution.hpp"

namespace muro::penalty {
namespace {

using NormalLaw = law::NormalLaw<double>;

/// Returns the force across the normal: muro::penalty::law with Eigen's vectors.
Vec3 friction_force(const Stiffness& s, double load, Vec3& displacement, const Vec3& slip, double most) {
  lane::V3<double> spring{displacement.x(), displacement.y(), displacement.z()};
  const lane::V3<double> f = law::FrictionLaw<double>(s, load).force(spring, {slip.x(), slip.y(), slip.z()}, most);
  displacement = {spring.x, spring.y, spring.z};
  return {f.x, f.y, f.z};
}

/// Lets a body of effective mass 1 fly against a wall at 1 m/s, with the impact at `phase` (0..1) of a step. Returns
/// the speed with which it leaves.
double rebound(double restitution, const Stiffness& s, double phase, double load = 1) {
  const NormalLaw law(s, damping_ratio_of(restitution), load);
  double x = phase * s.h, v = -1;
  bool touched = false;
  for (int k = 0; k < 100000; ++k) {
    if (touched && x >= 0) return v;
    touched = touched || x < 0;
    const double a = x < 0 ? law.force(-x, -v) : 0;
    x += v * s.h + 0.5 * a * s.h * s.h;
    v += a * s.h;
  }
  return -1;
}

TEST(ContactLaw, RestitutionIsThatOfAnIntegratedSpringDamper) {
  // x'' = -x - 2 zeta x' until the force vanishes, integrated with a step so fine that it counts as exact.
  for (const double zeta : {0.01, 0.1, 0.4, 0.9, 1.0, 1.3, 2.0}) {
    const double h = 1e-5;
    double x = 0, v = 1;
    for (double t = 0; x + 2 * zeta * v > 0 && t < 100; t += h) {
      const double a = -x - 2 * zeta * v, mid = v + 0.5 * h * a;
      const double a_mid = -(x + 0.5 * h * v) - 2 * zeta * mid;
      x += h * mid;
      v += h * a_mid;
    }
    EXPECT_NEAR(restitution_of(zeta), -v, 1e-4) << zeta;
  }
}

TEST(ContactLaw, ItsHyperbolicTangentIsThatOfTheLibrary) {
  for (double x = 0; x <= 2 * max_phase_step; x += 1e-4) EXPECT_NEAR(law::tanh(x), std::tanh(x), 4e-16) << x;
}

TEST(ContactLaw, TheDampingRatioInvertsTheRestitution) {
  for (double e = 0.15; e <= 1; e += 0.05) EXPECT_NEAR(restitution_of(damping_ratio_of(e)), e, 1e-12) << e;
  EXPECT_EQ(damping_ratio_of(0), max_damping_ratio);
  EXPECT_NEAR(restitution_of(max_damping_ratio), std::exp(-2), 1e-12);
}

TEST(ContactLaw, ARebound20StepsAPeriodHasItsRestitution) {
  const Stiffness s{2 * M_PI * 50, 1e-3};
  for (const auto& [e, error] : {std::pair{1.0, 1e-4}, {0.9, 0.005}, {0.7, 0.013}, {0.5, 0.023}, {0.2, 0.035}})
    for (double phase = 0.005; phase < 1; phase += 0.01) EXPECT_NEAR(rebound(e, s, phase), e, error) << phase;
}

TEST(ContactLaw, TheErrorOfARestitutionFallsWithTheStep) {
  const auto worst = [](double h) {
    double error = 0;
    for (double phase = 0.005; phase < 1; phase += 0.01)
      error = std::max(error, std::abs(rebound(0.5, {2 * M_PI * 50, h}, phase) - 0.5));
    return error;
  };
  EXPECT_NEAR(worst(1e-3) / worst(5e-4), 4, 0.7);
  EXPECT_NEAR(worst(5e-4) / worst(2.5e-4), 4, 0.7);
}

TEST(ContactLaw, NoReboundGainsEnergyHoweverCoarseTheStep) {
  for (const double share : {0.05, 0.2, 0.4, 1.0})
    for (const double e : {1.0, 0.9, 0.5, 0.0})
      for (const double load : {1.0, 3.0, 10.0})
        for (double phase = 0.005; phase < 1; phase += 0.01) {
          const double v = rebound(e, {max_phase_step * share / 1e-3, 1e-3}, phase, load);
          EXPECT_LE(v, 1 + 1e-9) << share << " " << e << " " << load << " " << phase;
          EXPECT_GT(v, 0);
        }
}

TEST(ContactLaw, NeverPulls) {
  const Stiffness s{300, 1e-3};
  for (const double e : {0.0, 0.5, 1.0})
    for (double v = -10; v <= 10; v += 0.37)
      for (double depth = 1e-6; depth < 0.02; depth *= 1.7)
        for (const double load : {1.0, 10.0}) EXPECT_GE(NormalLaw(s, damping_ratio_of(e), load).force(depth, v), 0);
}

TEST(ContactLaw, StaysStableUnderAnyLoad) {
  // A mode that is `load` times stiffer than a contact knows, with a restoring force in both directions, comes to rest.
  const Stiffness s{600, 1e-3};
  for (const double e : {0.0, 0.5, 0.95})
    for (const double load : {1.0, 3.0, 12.0, 100.0}) {
      const NormalLaw law(s, damping_ratio_of(e), load);
      double x = 1e-4, v = 0, greatest = 0;
      for (int k = 0; k < 20000; ++k) {
        const double offset = 1;  // a deep preload makes the contact a two-sided spring
        const double rest = law.force(offset, 0);
        const double a = load * (law.force(offset - x, -v) - rest);
        x += v * s.h + 0.5 * a * s.h * s.h;
        v += a * s.h;
        if (k > 19000) greatest = std::max(greatest, std::abs(x));
      }
      EXPECT_LT(greatest, 1e-6) << e << " " << load;
    }
}

TEST(ContactLaw, FrictionNeverExceedsTheConeInAnyDirection) {
  const Stiffness s{300, 1e-3};
  for (double angle = 0; angle < 6.28; angle += 0.1) {
    Vec3 displacement = Vec3::Zero();
    const Vec3 slip(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0);
    Vec3 force = Vec3::Zero();
    for (int k = 0; k < 50; ++k) {
      displacement += slip * s.h;
      force = friction_force(s, 1, displacement, slip, 5);
    }
    EXPECT_NEAR(force.norm(), 5, 1e-12);
    EXPECT_NEAR(force.dot(slip), -5 * 0.3, 1e-12);  // straight against the slip: a cone, not a pyramid
  }
}

TEST(ContactLaw, ABodyThatFrictionHoldsDoesNotCreep) {
  const Stiffness s{300, 1e-3};
  for (const double load : {1.0, 5.0}) {
    Vec3 x = Vec3::Zero(), v = Vec3::Zero(), displacement = Vec3::Zero(), middle = Vec3::Zero();
    const Vec3 pull(3, 0, 0);  // not gravity: friction cannot foresee it
    for (int k = 0; k < 4000; ++k) {
      displacement += v * s.h;
      const Vec3 a = pull + friction_force(s, load, displacement, v, 5);
      x += v * s.h + 0.5 * a * s.h * s.h;
      v += a * s.h;
      if (k == 2000) middle = x;
    }
    EXPECT_NEAR(x.x(), 3.0 / (300 * 300), 3e-5 * load);  // as far as the spring gives
    EXPECT_LT((x - middle).norm(), 1e-12);
  }
}

TEST(ContactLaw, ASlidingBodyStopsAfterTheTextbookDistance) {
  const Stiffness s{300, 1e-3};
  Vec3 x = Vec3::Zero(), v(2, 1, 0), displacement = Vec3::Zero();
  for (int k = 0; k < 3000; ++k) {
    displacement += v * s.h;
    const Vec3 a = friction_force(s, 1, displacement, v, 4);
    x += v * s.h + 0.5 * a * s.h * s.h;
    v += a * s.h;
  }
  EXPECT_NEAR(x.norm(), 5.0 / (2 * 4), 0.004);  // v^2 / (2 a), except for the way until the force has built up
  EXPECT_NEAR(x.y() / x.x(), 0.5, 1e-9);
  EXPECT_LT(v.norm(), 1e-9);
}

}  // namespace
}  // namespace muro::penalty
