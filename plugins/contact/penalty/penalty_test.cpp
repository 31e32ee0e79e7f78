// SPDX-License-Identifier: MIT
// Bodies: cases with closed forms, at 1000 Hz and 50 Hz stiffness unless stated.
#include <gtest/gtest.h>
#include <cmath>

#include <random>

#include "muro/toolkit/pair_surface.hpp"
#include "muro/toolkit/rotations.hpp"
#include "penalty_testing.hpp"

namespace muro {
namespace {

using namespace test;

/// A scene with one robot on a plane that falls by `angle` (rad) towards +x. `lift`: height of the base above the
/// plane.
struct Incline : ContactScene {
  Quat tilt;
  const RobotView* robot;
  Incline(double angle, double friction, const RobotTree& tree, double lift, double yaw = 0)
      : tilt(from_rpy(0, angle, 0)) {
    add_ground(friction, {Vec3::Zero(), tilt});
    robot = &add("r", tree, {tilt * Vec3(0, 0, lift), tilt * from_rpy(0, 0, yaw)});
    start();
  }
  double speed_after(double seconds) {
    run_for(seconds);
    return twist(*robot).linear.norm();
  }
};

TEST(Penalty, ABlockSlidesDownAnInclineAtTheTextbookRate) {
  Incline s(M_PI / 6, 0.3, block(3, {0.4, 0.3, 0.2}, 0.3), 0.1);
  const double first = s.speed_after(1), second = s.speed_after(1);
  EXPECT_NEAR(second - first, 2.3562872, 1e-7);  // g (sin - mu cos)
}

TEST(Penalty, ABlockSticksExactlyUpToTheAngleOfFriction) {
  // tan 30 deg = 0.57735. The friction springs hold without creep; the remainder is round-off.
  const auto creep = [](double friction) {
    Incline s(M_PI / 6, friction, block(3, {0.4, 0.3, 0.2}, friction), 0.1);
    s.run_for(10);  // the slide until it rests on the ground is braked by mu cos - sin only
    const Vec3 before = s.pose(*s.robot).position;
    s.run_for(10);
    return (s.pose(*s.robot).position - before).norm() / 10;
  };
  for (const double friction : {0.578, 0.6, 0.8}) EXPECT_LT(creep(friction), 1e-12) << friction;
  EXPECT_GT(creep(0.576), 0.01);
}

TEST(Penalty, RoundBodiesRollDownAnInclineAtTheTextbookRate) {
  // g sin / (1 + factor). They roll about a point half the depth inside: 0.07 mm of 100 mm.
  for (const double factor : {0.4, 0.5, 1.0}) {
    Incline s(20 * M_PI / 180, 0.8, ball(1, 0.1, 0.8, 0, factor), 0.1);
    const double first = s.speed_after(1), second = s.speed_after(1);
    EXPECT_NEAR((second - first) / (g * std::sin(20 * M_PI / 180) / (1 + factor)), 1, 7e-4) << factor;
  }
}

TEST(Penalty, ASlidingBallEndsUpRolling) {
  ContactScene s;
  s.add_ground(0.2);
  const RobotView& r = s.add("ball", ball(1, 0.1, 0.2), {{0, 0, 0.0999}, Quat::Identity()}, {{5, 0, 0}, {0, 0, 0}});
  s.start();
  s.run_for(0.7);
  const auto slip = [&] { return s.twist(r).linear.x() - 0.1 * s.twist(r).angular.y(); };
  EXPECT_GT(slip(), 0.1);
  while (slip() > 0.01 && s.now() < 2'000'000'000) s.run_for(0.001);
  EXPECT_NEAR(1e-9 * double(s.now()), 0.7281200, 0.004);
  EXPECT_NEAR(s.pose(r).position.x(), 3.1205143, 0.01);
  s.run_for(1);
  EXPECT_NEAR(s.twist(r).linear.x(), 3.5714286, 0.003);
}

TEST(Penalty, ABouncingBallMeetsTheGroundAtTheTimesOfItsSeries) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& r = s.add("ball", ball(1, 0.1, 0.5, 0.7), {{0, 0, 1.1}, Quat::Identity()});
  const double frequency = 1000;
  s.start(200000, frequency);
  std::vector<double> impacts;
  while (impacts.size() < 6 && s.now() < 3'000'000'000) {
    const double before = s.pose(r).position.z();
    s.run_for(5e-6);
    if (before >= 0.1 && s.pose(r).position.z() < 0.1) impacts.push_back(1e-9 * double(s.now()));
  }
  ASSERT_EQ(impacts.size(), 6u);
  const double series[] = {0.451524, 1.083657, 1.526150, 1.835895, 2.052717, 2.204492};
  for (int k = 0; k < 6; ++k) {
    // each touch lasts about half a period, which the series leaves out
    const double late = impacts[std::size_t(k)] - series[k];
    EXPECT_GT(late, -1e-4);
    EXPECT_LT(late, 1e-4 + k * 0.6 / frequency);
  }
}

TEST(Penalty, FrictionIsACone) {
  // Pushed with 1.02 mu N in any direction, a block moves along the push at 0.02 mu g; with 0.98 mu N it stays.
  for (double direction = 0; direction < 6.2; direction += M_PI / 8)
    for (const double share : {0.98, 1.02}) {
      ContactScene s;
      s.add_ground(0.5);
      const RobotView& r = s.add("block", block(2, {0.4, 0.4, 0.1}, 0.5), {{0, 0, 0.05}, Quat::Identity()});
      Wrench& push = s.push(r);
      s.start();
      s.run_for(0.3);
      const Vec3 along(std::cos(direction), std::sin(direction), 0), before = s.pose(r).position;
      for (int k = 1; k <= 300; ++k) {  // gently: a sudden push would break it loose
        push.force = k / 300.0 * share * 0.5 * 2 * g * along;
        s.run_for(0.001);
      }
      s.run_for(0.5);
      const Vec3 early = s.twist(r).linear;
      s.run_for(0.5);
      if (share < 1) {
        EXPECT_LT((s.pose(r).position - before).norm(), 5e-4);
        EXPECT_LT(s.twist(r).linear.norm(), 1e-9);
      } else {
        const Vec3 gained = (s.twist(r).linear - early) / 0.5;
        EXPECT_NEAR(gained.dot(along), 0.02 * 0.5 * g, 1e-4) << direction;
        EXPECT_LT(gained.cross(along).norm(), 1e-4) << direction;
      }
    }
}

/// Total momentum, angular momentum about the origin and energy of free bodies.
struct Ledger {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double energy = 0;
  explicit Ledger(ContactScene& s) {
    for (const RobotView* r : s.world().robots()) {
      const Inertia body = s.world().value(r->base(), keys::inertial);
      const Mat3 turn = s.pose(*r).orientation.toRotationMatrix();
      const Twist v = s.twist(*r);
      const Vec3 spin = turn * body.tensor() * turn.transpose() * v.angular;
      linear += body.mass * v.linear;
      angular += s.pose(*r).position.cross(body.mass * v.linear) + spin;
      energy += 0.5 * body.mass * v.linear.squaredNorm() + 0.5 * v.angular.dot(spin);
    }
  }
};

TEST(Penalty, CollidingBodiesKeepTheirMomentaAndGainNoEnergy) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int collisions = 0;
  for (int trial = 0; trial < 30; ++trial) {
    ContactScene s;
    s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const double friction = trial % 3 == 0 ? 0 : 0.5, restitution = trial % 2 == 0 ? 1 : 0.4;
    const Vec3 spin(3 * unit(random), 3 * unit(random), 3 * unit(random)),
        aside(0, 0.1 * unit(random), 0.1 * unit(random));
    const RobotTree first =
        trial % 4 < 2 ? ball(1, 0.15, friction, restitution) : block(1, {0.3, 0.2, 0.25}, friction, restitution);
    const RobotTree second =
        trial % 4 < 1 ? ball(3, 0.2, friction, restitution) : block(3, {0.3, 0.4, 0.25}, friction, restitution);
    const RobotView& a = s.add("a", first, {{0, 0, 0}, from_rpy(unit(random), unit(random), 0)}, {{1.5, 0.2, 0}, spin});
    s.add("b", second, {Vec3(0.7, 0, 0) + aside, from_rpy(0, unit(random), unit(random))}, {{-1, 0, 0.1}, -spin});
    s.start();
    const Ledger before(s);
    const Vec3 course = s.twist(a).linear;
    s.run_for(1);
    const Ledger after(s);
    collisions += (s.twist(a).linear - course).norm() > 0.1;
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm() + 1e-12) << trial;
    EXPECT_LT((after.angular - before.angular).norm(), 1e-12) << trial;
    EXPECT_LE(after.energy, before.energy * 1.001) << trial;
  }
  EXPECT_GE(collisions, 20);
}

TEST(Penalty, APlateThatSpinsOnARobotIsSlowedByThePressureOverIt) {
  // Torque of an even pressure over a square: 0.3826 mu N a; the slab turns with it.
  constexpr double side = 0.3, mu = 0.5, inertia = side * side / 6;
  ContactScene s;
  s.add_ground(1);
  const RobotView& slab = s.add("slab", block(50, {1, 1, 0.1}, mu), {{0, 0, 0.05}, Quat::Identity()});
  const RobotView& plate = s.add("plate",
                                 single_body(with(Shape::box({side, side, 0.02}), mu),
                                             {.mass = 1, .ixx = 0.6 * inertia, .iyy = 0.6 * inertia, .izz = inertia}),
                                 {{0, 0, 0.11}, Quat::Identity()}, {Vec3::Zero(), {0, 0, 20}});
  s.start();
  s.run_for(0.1);
  const double before = s.twist(plate).angular.z();
  s.run_for(0.2);
  EXPECT_NEAR((before - s.twist(plate).angular.z()) / 0.2, 0.3826 * mu * g * side / inertia, 0.05 * 37.5);
  EXPECT_LT(s.twist(slab).angular.norm(), 1e-3);
  s.run_for(1);
  EXPECT_LT(std::abs(s.twist(plate).angular.z()), 1e-9);
  EXPECT_LT(s.twist(plate).angular.norm(), 1e-5);
  EXPECT_NEAR(s.pose(plate).position.z(), 0.11, 2e-4);
}

TEST(Penalty, ForcesOfAPairAreOppositeToTheBit) {
  ContactScene s;
  s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& a =
      s.add("a", block(1, {0.3, 0.2, 0.25}, 0.7), {{0, 0, 0}, from_rpy(0.1, 0.2, 0.3)}, {{1, 0.3, 0.1}, {1, 2, 3}});
  const RobotView& b =
      s.add("b", block(2, {0.3, 0.4, 0.2}, 0.7), {{0.4, 0.03, 0.02}, from_rpy(0.3, 0.1, 0)}, {{-1, 0, 0}, {3, 1, 0}});
  s.start();
  int touching = 0;
  for (int k = 0; k < 500; ++k) {
    s.run_for(0.001);
    const Vec3 on_a = s.external(a).force, on_b = s.external(b).force;
    touching += on_a.norm() > 0;
    ASSERT_EQ(on_a, -on_b);
  }
  EXPECT_GT(touching, 2);
}

TEST(Penalty, ABoxThatLandsFlatReboundsWithItsRestitution) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& r = s.add("box", block(3, {0.4, 0.3, 0.2}, 0.5, 0.6), {{0, 0, 0.6}, Quat::Identity()});
  s.start();
  double fastest = 0;
  while (s.now() < 500'000'000) {
    s.run_for(0.001);
    fastest = std::max(fastest, s.twist(r).linear.z());
  }
  EXPECT_NEAR(fastest, 0.6 * std::sqrt(2 * g * 0.5), 0.06 * std::sqrt(2 * g * 0.5));
}

TEST(Penalty, TheRollingStackMovesAsInTheBenchmark) {
  // SimBenchmark's set-up: 25 balls on a box that is drawn over the ground, along an axis or not. Box 0.7385, balls
  // 0.211 m/s^2. Friction: box-ground 0.4, box-ball 0.8 (geometric means).
  for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(0.5, 0.8660254, 0)}) {
    ContactScene s;
    s.world().set(world_object, keys::friction_rule, std::uint32_t(FrictionRule::mean));
    s.add_ground(0.2);
    const RobotView& box = s.add("box", block(10, {20, 20, 1}, 0.8), {{0, 0, 0.5}, Quat::Identity()});
    std::vector<const RobotView*> balls;
    const RobotTree tree = ball(1, 0.5, 0.8);
    for (int k = 0; k < 25; ++k)
      balls.push_back(&s.add("ball" + std::to_string(k), tree,
                             {{2.0 * (k % 5) - 4, 2.0 * std::floor(0.2 * k) - 4, 1.5}, Quat::Identity()}));
    Wrench& push = s.push(box);
    s.start();
    push.force = 150 * direction;
    s.run_for(1);
    const Vec3 box_early = s.twist(box).linear, ball_early = s.twist(*balls[7]).linear;
    s.run_for(1);
    EXPECT_NEAR((s.twist(box).linear - box_early).dot(direction), 0.7385, 0.002);
    EXPECT_NEAR((s.twist(*balls[7]).linear - ball_early).dot(direction), 0.211, 0.001);
    EXPECT_LT(s.twist(box).linear.cross(direction).norm(), 1e-3);
  }
}

TEST(Penalty, AKinematicRobotPushesAndIsNotPushed) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& pusher = s.add("pusher", block(1, {0.2, 0.4, 0.2}, 0.5), {{0, 0, 0.15}, Quat::Identity()});
  const RobotView& box = s.add("box", block(5, {0.2, 0.4, 0.2}, 0.5), {{0.25, 0, 0.1}, Quat::Identity()});
  s.use("motion.point", 1000, {{&pusher, pusher.base()}});
  s.use("motion.simplified", 1000, {{&box, box.base()}});
  s.use_contacts();
  s.build();
  s.world().value(pusher.base(), keys::command_twist) = {{0.3, 0, 0}, {0, 0, 0}};
  s.run_for(2);
  EXPECT_NEAR(s.pose(pusher).position.x(), 0.6, 1e-9);
  EXPECT_NEAR(s.twist(box).linear.x(), 0.3, 1e-3);
  EXPECT_NEAR(s.pose(box).position.x(), 0.8, 2e-3);
}

/// The block rolls over its edges, so its contacts begin, end and jump.
TEST(Penalty, ATumblingBlockGoesTheSameWayFromASnapshotOfAnyStep) {
  test::ContactScene s;
  s.add_ground(0.6);
  s.add_box("wall", {2, 0, 0.5}, {0.2, 4, 1}, 0.6);
  for (int i = 0; i < 3; ++i)
    s.add("block_" + std::to_string(i), test::block(1, {0.3, 0.2, 0.25 + 0.05 * i}, 0.6),
          {{0, double(i), 0.4}, from_rpy(0.3 * i, 0.5, 0.2)}, {{3, 0.2, 1}, {4, 7, 1}});
  s.start();
  s.verify_access();  // repeats each step after restored()
  EXPECT_NO_THROW(s.run_for(1.5));
}

TEST(Penalty, ARestoredSnapshotGoesOnToTheSameBits) {
  Incline s(0.4, 0.8, block(3, {0.4, 0.3, 0.2}, 0.8), 0.15);
  s.run_for(0.3);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.5);
  EXPECT_EQ(s.state_hash(), end);
}

}  // namespace
}  // namespace muro
