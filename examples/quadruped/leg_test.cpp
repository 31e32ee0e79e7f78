// SPDX-License-Identifier: MIT
// Legs, gait, placement and the distribution of forces against closed forms, and against the simulator.
#include <gtest/gtest.h>

#include <random>

#include "balance.hpp"
#include "gait.hpp"
#include "generated_robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "leg.hpp"
#include "muro/vocabulary.hpp"
#include "placement.hpp"
#include "tests/support/scene.hpp"

namespace muro::quadruped_test {
namespace {

using quadruped::Leg;
using quadruped::Vector;

Vec3 eigen(const Vector& v) { return {v.x, v.y, v.z}; }

/// Random legs, and angles that a leg can reach: bent in its direction, and not quite straight.
struct RandomLegs {
  std::mt19937 random{7};
  double next(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  Leg leg() {
    return {{next(-0.3, 0.3), next(-0.2, 0.2), next(-0.1, 0.1)},
            next(-0.15, 0.15),
            next(0.05, 0.5),
            next(0.05, 0.5),
            next(-1, 1) < 0 ? -1.0 : 1.0};
  }
  Vector angles(const Leg& l) { return {next(-0.7, 0.7), next(-0.7, 0.7), l.bend * next(0.2, 1.6)}; }
};

TEST(Leg, InverseKinematicsGoesBackToTheSameAngles) {
  RandomLegs some;
  for (int i = 0; i < 2000; ++i) {
    const Leg leg = some.leg();
    const Vector q = some.angles(leg), p = leg.foot(q);
    if (leg.thigh * std::cos(q.y) + leg.shank * std::cos(q.y + q.z) < 0.02) continue;  // the foot is above its hip
    EXPECT_LT((leg.angles(p) - q).norm(), 1e-9) << i;
  }
}

TEST(Leg, JacobianIsTheDerivativeOfTheFoot) {
  RandomLegs some;
  const double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const Leg leg = some.leg();
    const Vector q = some.angles(leg);
    const Leg::Jacobian j = leg.jacobian(q);
    const Vector steps[] = {{h, 0, 0}, {0, h, 0}, {0, 0, h}};
    for (int k = 0; k < 3; ++k) {
      const Vector difference = (0.5 / h) * (leg.foot(q + steps[k]) - leg.foot(q - steps[k]));
      EXPECT_LT((difference - j.columns[k]).norm(), 1e-9) << i << ", " << k;
    }
    const Vector rates{0.3, -0.5, 0.7}, force{3, -4, 50};
    EXPECT_NEAR(dot(j * rates, force), dot(rates, j.efforts(force)), 1e-12) << "power";
    EXPECT_LT((j.rates(j * rates, 0) - rates).norm(), 1e-9);
  }
}

TEST(Leg, WhatIsOutOfReachIsDrawnNear) {
  const Leg leg{{}, 0.06, 0.2, 0.2, -1};
  const Vector far = leg.foot(leg.angles({0.3, 0.06, -0.6}));
  EXPECT_NEAR((far - Vector{0, 0.06, 0}).norm(), 0.4, 1e-6);
  EXPECT_NEAR(far.x / far.z, -0.5, 1e-6) << "along the line from the hip";
  for (const Vector& p : {Vector{0, 0, 0}, Vector{0, 0.06, 0}, Vector{0, 0.01, 0.01}})
    EXPECT_TRUE(std::isfinite(leg.angles(p).norm()));
  EXPECT_TRUE(std::isfinite(leg.jacobian({0, 0, 0}).rates({1, 1, 1}, 1e-4).norm())) << "a straight leg";
}

/// Returns the feet of a model with joints at these positions, seen from the base, by the simulator.
std::vector<Vec3> feet_of(const std::string& model, const std::vector<std::string>& feet, const std::string& joints) {
  const test::ScratchFolder folder;
  const std::string file = folder.file(
      "s.yaml", "robots: {r: {model: " + model + ", at: {x: 1, z: 2, roll: 0.1, yaw: 0.4}, joints: {" + joints + "}}}");
  const host::BuiltScenario built = host::build(host::read_scenario(file, {}), test::plugins());
  built.simulation->refresh();
  const World& world = built.simulation->world();
  const Pose base = world.value("r/base_link", keys::pose);
  std::vector<Vec3> places;
  for (const std::string& foot : feet)
    places.push_back(base.orientation.conjugate() * (world.value("r/" + foot, keys::pose).position - base.position));
  return places;
}

TEST(Leg, FeetAreWhereTheSimulatorHasThem) {
  RandomLegs some;
  const std::string models = MURO_TEST_SOURCE_DIR "/examples/models/";
  for (int i = 0; i < 5; ++i) {
    std::string joints, joints_a1;
    std::vector<Vec3> expected, expected_a1;
    for (const auto& [name, a1, x, y] : {std::tuple{"front_left", "FL", 1, 1},
                                         {"front_right", "FR", 1, -1},
                                         {"rear_left", "RL", -1, 1},
                                         {"rear_right", "RR", -1, -1}}) {
      const Vector q{some.next(-0.7, 0.7), some.next(-0.9, 1.5), some.next(-2.5, -1)};
      const auto with = [&](const std::string& leg, const char* roll, const char* pitch, const char* knee) {
        return leg + roll + ": " + number(q.x) + ", " + leg + pitch + ": " + number(q.y) + ", " + leg + knee + ": " +
               number(q.z) + ", ";
      };
      joints += with(name, "_hip_roll", "_hip_pitch", "_knee");
      joints_a1 += with(a1, "_hip_joint", "_thigh_joint", "_calf_joint");
      const Leg leg{{0.18 * x, 0.07 * y, 0}, 0.06 * y, 0.2, 0.2, -1};
      const Leg leg_a1{{0.1805 * x, 0.047 * y, 0}, 0.0838 * y, 0.2, 0.2, -1};
      expected.push_back(eigen(leg.hip + leg.foot(q)));
      expected_a1.push_back(eigen(leg_a1.hip + leg_a1.foot(q)));
    }
    joints.resize(joints.size() - 2), joints_a1.resize(joints_a1.size() - 2);
    const auto feet = feet_of(models + "quadruped.urdf",
                              {"front_left_foot", "front_right_foot", "rear_left_foot", "rear_right_foot"}, joints);
    const auto feet_a1 = feet_of(models + "quadruped_a1.urdf", {"FL_foot", "FR_foot", "RL_foot", "RR_foot"}, joints_a1);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT((feet[k] - expected[k]).norm(), 1e-9) << k;
      EXPECT_LT((feet_a1[k] - expected_a1[k]).norm(), 1e-9) << k;
    }
  }
}

TEST(Leg, SignsAndZerosOfJointsAreThoseOfTheModel) {
  RandomLegs some;
  for (const Numbers& n : {mini_cheetah(), large()}) {
    const GeneratedRobot robot(n);
    const test::ScratchFolder folder;
    std::string joints;
    std::vector<Vec3> expected;
    std::vector<std::string> feet;
    for (const std::string name : GeneratedRobot::legs) {
      const Vector q{some.next(-0.7, 0.7), some.next(-0.9, 0.9), some.next(-2, 2)};
      joints += name + "_hip_roll: " + number(robot.position(name, 0, q.x)) + ", " + name +
                "_hip_pitch: " + number(robot.position(name, 1, q.y)) + ", " + name +
                "_knee: " + number(robot.position(name, 2, q.z)) + ", ";
      const double side = name[1] == 'L' ? 1 : -1;
      const Leg leg{{name[0] == 'F' ? n.hip_front : n.hip_rear, side * n.hip_side, n.hip_up},
                    side * n.abduction,
                    n.thigh,
                    n.shank,
                    robot.bend(name)};
      expected.push_back(eigen(leg.hip + leg.foot(q)));
      feet.push_back(name + "_foot");
    }
    joints.resize(joints.size() - 2);
    const auto places = feet_of(folder.file("generated.urdf", robot.urdf()), feet, joints);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((places[k] - expected[k]).norm(), 1e-9) << k;
  }
}

TEST(Gait, DiagonalPairsSwingInTurn) {
  const quadruped::Gait gait{0.4, 0.6};
  quadruped::GaitClock clock;
  clock.start(gait);
  double stands[4] = {};
  for (int i = 0; i < 4000; ++i) {
    bool swings[4];
    for (int leg = 0; leg < 4; ++leg) swings[leg] = clock.of(gait, leg).swings, stands[leg] += !swings[leg] / 4000.0;
    EXPECT_EQ(swings[quadruped::front_left], swings[quadruped::rear_right]);
    EXPECT_EQ(swings[quadruped::front_right], swings[quadruped::rear_left]);
    EXPECT_FALSE(swings[quadruped::front_left] && swings[quadruped::front_right]);
    clock.advance(gait, 0.001, false);
  }
  for (const double part : stands) EXPECT_NEAR(part, 0.6, 0.003);
  for (int i = 0; i < 400 && clock.runs != 0; ++i) clock.advance(gait, 0.001, true);
  for (int leg = 0; leg < 4; ++leg) EXPECT_FALSE(clock.of(gait, leg).swings) << "it has stopped";
}

TEST(Placement, PutsFeetWhereRaibertSays) {
  const quadruped::Placement rule{.gain = 0.05, .farthest = 0.2, .height = 0.3, .gravity = 9.81};
  const Vector hip{0.2, 0.1, 0};
  const Vector neutral = rule.target(hip, {0.5, -0.2, 0}, {0.5, -0.2, 0}, 0.2);
  EXPECT_LT((neutral - Vector{0.25, 0.08, 0}).norm(), 1e-12) << "hip + v T / 2";
  const Vector fast = rule.target(hip, {0.7, 0, 0}, {0.5, 0, 0}, 0.2);
  EXPECT_NEAR(fast.x, 0.2 + 0.07 + 0.05 * 0.2, 1e-12);
  const Vector turned = rule.target(hip, {}, {0, 0, 1}, 0.2);
  EXPECT_LT(
      (turned - Vector{0.2 * std::cos(0.1) - 0.1 * std::sin(0.1), 0.2 * std::sin(0.1) + 0.1 * std::cos(0.1), 0}).norm(),
      1e-12);
  const Vector pushed = rule.target(hip, {5, 5, 0}, {}, 0.2);
  EXPECT_NEAR((pushed - hip).norm(), 0.2, 1e-12);
}

TEST(Placement, ASwingingFootLeavesAndLandsAtTheSpeedOfTheGround) {
  const quadruped::Arc arc{{-0.05, 0.1, -0.3}, 0.06, 0.2};
  const Vector to{0.07, 0.12, -0.29}, ground{-0.5, 0.1, 0};
  for (const double end : {0.0, 1.0}) {
    const auto at = arc.at(end, to, ground);
    EXPECT_LT((at.position - (end == 0 ? arc.from : to)).norm(), 1e-12);
    EXPECT_LT((at.velocity - ground).norm(), 1e-12);
  }
  EXPECT_NEAR(arc.at(0.5, to, ground).position.z, -0.295 + 0.06, 1e-12);
  for (double t = 0.05; t < 1; t += 0.1) {
    const Vector difference =
        (1 / (0.2 * 2e-6)) * (arc.at(t + 1e-6, to, ground).position - arc.at(t - 1e-6, to, ground).position);
    EXPECT_LT((difference - arc.at(t, to, ground).velocity).norm(), 1e-6) << t;
  }
}

TEST(Balance, FourFeetMakeTheWrenchThatIsWanted) {
  quadruped::ForceDistribution share;
  share.most = 1e6, share.friction = 2;
  const std::array<Vector, 4> arms{{{0.2, 0.1, -0.3}, {0.21, -0.1, -0.3}, {-0.2, 0.12, -0.31}, {-0.18, -0.1, -0.3}}};
  const quadruped::BodyWrench wanted{{0, 0, 120}, {2, -3, 0}};
  const auto forces = share.share(wanted, {true, true, true, true}, arms);
  Vector force, torque;
  for (std::size_t i = 0; i < 4; ++i) force = force + forces[i], torque = torque + cross(arms[i], forces[i]);
  EXPECT_NEAR(force.z, 120, 0.01 * 120);
  EXPECT_NEAR(torque.x, 2, 0.05);
  EXPECT_NEAR(torque.y, -3, 0.05);
}

TEST(Balance, FeetPushWithinTheirConesAndOnlyThoseThatStand) {
  RandomLegs some;
  const quadruped::ForceDistribution share{.friction = 0.5, .least = 5, .most = 200};
  for (int i = 0; i < 300; ++i) {
    const quadruped::BodyWrench wanted{{some.next(-200, 200), some.next(-200, 200), some.next(-100, 400)},
                                       {some.next(-50, 50), some.next(-50, 50), some.next(-50, 50)}};
    std::array<Vector, 4> arms;
    std::array<bool, 4> stands;
    for (std::size_t k = 0; k < 4; ++k)
      arms[k] = {some.next(-0.3, 0.3), some.next(-0.3, 0.3), -0.3}, stands[k] = some.next(0, 1) < 0.5;
    const auto forces = share.share(wanted, stands, arms);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!stands[k]) {
        EXPECT_EQ(forces[k].norm(), 0);
        continue;
      }
      EXPECT_GE(forces[k].z, 5);
      EXPECT_LE(forces[k].z, 200);
      EXPECT_LE(std::hypot(forces[k].x, forces[k].y), 0.5 * forces[k].z * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace muro::quadruped_test
