// SPDX-License-Identifier: MIT
// Walkers compared with closed forms: a compass, a robot that turns, ties of both feet, tilted soles.
#include <gtest/gtest.h>

#include "plugins/common/mesh/files_testing.hpp"
#include "tests/support/files.hpp"
#include "walker_testing.hpp"

namespace muro::biped::testing {
namespace {

constexpr double degree = M_PI / 180;

TEST(CompassWalker, GoesTwoLSinAWithEachStepOfItsLegs) {
  const Compass legs;
  const double step = 2 * leg_length * std::sin(legs.a);
  EXPECT_NEAR(step, 0.2052121, 5e-8);
  Walk w(100, {}, legs.start());
  const Vec3 start = w.base().position;
  double lowest = 1;
  for (int k = 1; k <= 400; ++k) {
    legs.set(w, k * 0.01);
    w.run_for(0.01);
    lowest = std::min(lowest, w.base().position.z());
    if (k % 40 != 0) continue;
    const int steps = k / 40;
    ASSERT_LT((w.base().position - start - Vec3(steps * step, 0, 0)).norm(), 1e-9) << "after " << steps << " steps";
    ASSERT_LT(w.base().orientation.vec().norm(), 1e-9) << "the trunk is upright";
  }
  EXPECT_NEAR(lowest, 0.2819078, 5e-8);
  EXPECT_NEAR(lowest, leg_length * std::cos(legs.a), 1e-9);
  EXPECT_EQ(w.footholds(), 10u) << "the first of the start, then one for each step that has begun";
}

TEST(CompassWalker, MovesOnAnArcAboutItsAnkleBetweenSteps) {
  const Compass legs;
  Walk w(100, {}, legs.start());
  const Vec3 ankle = w.base().position + leg_length * Vec3(std::sin(legs.a), 0, -std::cos(legs.a));
  for (int k = 1; k < 40; ++k) {
    legs.set(w, k * 0.01);
    w.run_for(0.01);
    const double s = legs.a * (2 * k / 40.0 - 1);
    const Vec3 hip = w.base().position - ankle;
    ASSERT_NEAR(hip.x(), leg_length * std::sin(s), 1e-12);
    ASSERT_NEAR(hip.z(), leg_length * std::cos(s), 1e-12);
    ASSERT_EQ(w.contact("left_foot"), 1u);
    ASSERT_EQ(w.contact("right_foot"), 0u);
  }
}

TEST(CompassWalker, ItsVelocityJumpsByTwoLSinAAtAStep) {
  const Compass legs;
  const double dt = 0.01, rate = 2 * legs.a / legs.period;  // rad/s: velocity of the hips
  Walk w(1 / dt, {}, legs.start());
  const auto velocity_at = [&](double s) { return Vec3(leg_length * rate * Vec3(std::cos(s), 0, -std::sin(s))); };
  for (int k = 1; k <= 60; ++k) {
    legs.set(w, k * dt);
    w.run_for(dt);
    const double s = legs.a * (2 * (k <= 40 ? k : k - 40) / 40.0 - 1);  // angle of the stance leg
    ASSERT_LT((w.twist(w.robot).linear - velocity_at(s)).norm(), 1e-9) << "step " << k;
    ASSERT_LT(w.twist(w.robot).angular.norm(), 1e-9);
  }
  EXPECT_NEAR((velocity_at(-legs.a) - velocity_at(legs.a)).norm() / rate, 0.2052121, 5e-8);
}

TEST(CompassWalker, ClimbsAnInclinedPlane) {
  const Compass legs;
  const double p = 10 * degree;
  const Pose plane{{1, -2, 0.5}, rotation_about(Vec3(0, 0, 1), 0.4) * rotation_about(Vec3::UnitY(), -p)};
  Walk w(100, {}, legs.start(), plane);
  const Vec3 start = w.base().position;
  for (int k = 1; k <= 200; ++k) {
    legs.set(w, k * 0.01);
    w.run_for(0.01);
  }
  const Vec3 way = w.base().position - start;
  EXPECT_NEAR(way.z() / 5, 0.0356347, 5e-8);
  EXPECT_LT((way - plane.orientation * Vec3(5 * 2 * leg_length * std::sin(legs.a), 0, 0)).norm(), 1e-9);
}

/// Legs that swing to and fro against each other, and are shortened in turn, a part of the period later:
/// s = a sin(w t), c = (c0 / 2) (1 -+ sin(w t + phase)). Feet are at one height when both are shortened alike, at
/// w t = n pi - phase, and a foot comes down while the legs swing. All commands are smooth.
struct Swing {
  double a = 20 * degree, lift = 0.03, phase = 0.8, omega = 2 * M_PI / 0.8274;

  double angle(double t) const { return a * std::sin(omega * t); }
  double shorter(double t) const { return 0.5 * lift * (1 + std::sin(omega * t + phase)); }
  /// Returns the distance along the plane from the left ankle to the hip (m).
  double ahead(double t) const { return (leg_length - shorter(t)) * std::sin(angle(t)); }
  void set(Walk& w, double t) const {
    for (const bool is_left : {true, false}) {
      const std::string leg = is_left ? "left_" : "right_";
      const double s = is_left ? angle(t) : -angle(t);
      w.set(leg + "hip", s);
      w.set(leg + "ankle", -s);
      w.set(leg + "lift", is_left ? shorter(t) : lift - shorter(t));
    }
  }
  /// Returns the way of the hip along the plane in `t` (m). The left foot stands while its leg is shortened less.
  double way(double t) const {
    double sum = 0, from = 0;
    bool left_stands = false;  // before the first change
    for (int n = 1;; ++n) {
      const double down = (n * M_PI - phase) / omega, to = std::min(down, t);
      const auto in_stance = [&](double at) {
        return left_stands ? ahead(at) : -(leg_length - lift + shorter(at)) * std::sin(angle(at));
      };
      sum += in_stance(to) - in_stance(from);
      if (down >= t) return sum;
      from = to, left_stands = !left_stands;
    }
  }
};

/// Returns the error of the position of the hip after 4 s (m).
double error_of_swing(double dt) {
  const Swing legs;
  Walk w(1 / dt, {}, {{"left_lift", legs.shorter(0)}, {"right_lift", legs.lift - legs.shorter(0)}});
  const double start = w.base().position.x();
  for (int k = 1; k <= std::lround(4 / dt); ++k) {
    legs.set(w, k * dt);
    w.run_for(dt);
  }
  return std::abs(w.base().position.x() - start - legs.way(4));
}

TEST(CompassWalker, HasNoErrorOfFirstOrderInTheStep) {
  EXPECT_LT(Swing().way(4), -1) << "it walks, backwards";
  const double coarse = error_of_swing(0.02), fine = error_of_swing(0.002);
  EXPECT_LT(coarse, 3e-3);
  EXPECT_LT(fine, coarse / 50) << "a tenth of the step, a hundredth of the error";
}

TEST(CompassWalker, WithRigidLegsStandsOnOneFootForever) {
  Compass legs;
  legs.lift = 0;
  Walk w(100, {}, legs.start());
  const Vec3 start = w.base().position;
  const Pose stands = w.stance(own::stance_pose);
  for (int k = 1; k <= 800; ++k) {
    const double s = legs.a * std::cos(2 * M_PI * k / 80);
    for (const std::string leg : {"left_", "right_"}) {
      const double angle = leg == "left_" ? -s : s;
      w.set(leg + "hip", angle);
      w.set(leg + "ankle", -angle);
    }
    w.run_for(0.01);
  }
  EXPECT_EQ(w.footholds(), 1u) << "both feet are at height 0 all the time";
  EXPECT_EQ(w.stance(own::stance_pose).position, stands.position);
  EXPECT_LT((w.base().position - start).norm(), 1e-12) << "after ten periods";
  EXPECT_EQ(w.contact("left_foot"), 1u);
  EXPECT_EQ(w.contact("right_foot"), 1u) << "it slides along the plane";
}

TEST(CompassWalker, GoesOnMeshesAsOnTheirHulls) {
  const test::ScratchFolder folder;
  const std::string plate =
      folder.file("plate.stl", mesh::testing::stl_text(mesh::testing::box(Vec3(-0.5 * foot_length, -0.025, 0),
                                                                          Vec3(0.5 * foot_length, 0.025, 0.02))));
  Compass legs;
  legs.toe_up = 0.05;
  Walk boxes(100, {}, legs.start()), meshes(100, {}, legs.start(), {}, {}, {}, plate);
  for (int k = 1; k <= 100; ++k)
    for (Walk* w : {&boxes, &meshes}) {
      legs.set(*w, k * 0.01);
      w->run_for(0.01);
    }
  EXPECT_GT(boxes.base().position.x(), 0.4);
  EXPECT_LT((boxes.base().position - meshes.base().position).norm(), 1e-6) << "a file of single precision";
  EXPECT_EQ(boxes.footholds(), meshes.footholds());
}

TEST(TurningWalker, TurnsAboutTheLineThroughTheHipOfTheStanceLeg) {
  const double q = 10 * degree;
  Walk w(100);
  const Vec3 start = w.base().position;
  const int steps = 20;  // steps of the simulation per step of the robot
  double yaw[2] = {0, 0};
  for (int n = 0; n < 36; ++n) {
    const int stance = n % 2, swing = 1 - stance;
    const double from[2] = {yaw[0], yaw[1]};
    for (int k = 1; k <= steps; ++k) {
      const double part = double(k) / steps;
      yaw[stance] = from[stance] - q * part;
      yaw[swing] = from[swing] * (1 - part);
      for (const int leg : {0, 1}) {
        const std::string side = leg == 0 ? "left_" : "right_";
        w.set(side + "yaw", yaw[leg]);
        w.set(side + "lift", leg == swing ? 0.02 * std::sin(M_PI * part) : 0);
      }
      w.run_for(0.01);
    }
    const Vec3 way = w.base().position - start;
    if (n == 0) {
      EXPECT_NEAR(way.norm(), 0.0064495, 5e-8);
    } else if (n == 7) {
      EXPECT_NEAR(way.x(), 0.0026750, 5e-8);
      EXPECT_NEAR(way.y(), -0.0031879, 5e-8);
      EXPECT_NEAR(yaw_of(w.base().orientation), 80 * degree, 1e-9);
    }
    ASSERT_NEAR(way.z(), 0, 1e-12);
  }
  EXPECT_LT((w.base().position - start).norm(), 1e-9) << "after 36 steps of 10 deg";
  EXPECT_LT(w.base().orientation.angularDistance(Quat::Identity()), 1e-9);
}

double pitch_of(const Quat& q) { return std::asin(std::clamp((q * Vec3::UnitX()).z() * -1, -1.0, 1.0)); }

/// Returns the pitch of the trunk (rad) at the end of each stance when every foot comes down with its toe up by
/// `toe_up`.
std::vector<double> pitch_at_ends(double toe_up, double& lowest_sole, double& largest) {
  Compass legs;
  legs.a = 15 * degree;
  legs.toe_up = toe_up;
  Walk w(200, {}, legs.start());
  std::vector<double> ends;
  for (int k = 1; k <= 80 * 10; ++k) {
    legs.set(w, k * 0.005);
    w.run_for(0.005);
    for (const std::string foot : {"left_foot", "right_foot"})
      for (const double x : {-0.5, 0.5})
        lowest_sole = std::min(lowest_sole, (w.link(foot) * Vec3(x * foot_length, 0, 0)).z());
    largest = std::max(largest, std::abs(pitch_of(w.base().orientation)));
    if (k % 80 == 40) ends.push_back(pitch_of(w.base().orientation));  // in the middle: half of the tilt remains
  }
  return ends;
}

TEST(ATiltedSole, GoesFlushAtAStepSoThatPitchDoesNotAddUp) {
  const double tilt = 4 * degree;
  double lowest = 0, largest = 0;
  const std::vector<double> pitch = pitch_at_ends(tilt, lowest, largest);
  EXPECT_GT(lowest, -1e-9);
  EXPECT_LT(largest, 1.05 * tilt) << "the jump of the trunk at a step is the tilt of the sole";
  EXPECT_GT(largest, 0.9 * tilt);
  for (std::size_t n = 1; n < pitch.size(); ++n)
    EXPECT_NEAR(pitch[n], 0.5 * tilt, 1e-9) << "step " << n << ": the tilt that the ankle has not taken back yet";
}

TEST(ATiltedSole, ThatComesDownToeFirstGoesFlushWhenTheOtherFootLetsIt) {
  const double tilt = -4 * degree;
  double lowest = 0, largest = 0;
  const std::vector<double> pitch = pitch_at_ends(tilt, lowest, largest);
  EXPECT_GT(lowest, -1e-9) << "the heel of the foot behind is not pressed into the ground";
  EXPECT_LT(largest, 1.05 * std::abs(tilt));
  for (std::size_t n = 1; n < pitch.size(); ++n) EXPECT_NEAR(pitch[n], 0.5 * tilt, 1e-9) << "step " << n;
}

}  // namespace
}  // namespace muro::biped::testing
