// SPDX-License-Identifier: MIT
// Effects of a biped on others, and readings of its sensors.
#include <gtest/gtest.h>

#include "walker_testing.hpp"

namespace muro::biped::testing {
namespace {

constexpr double g = 9.81;

TEST(ABiped, KicksABallWithTheVelocityOfItsFoot) {
  for (const std::string motion : {"motion.simplified", "motion.articulated", "motion.mujoco"}) {
    const auto catalog = test::plugins().catalog();
    if (std::none_of(catalog.begin(), catalog.end(), [&](const CatalogEntry& o) { return o.id == motion; })) continue;
    test::Scene s;
    s.add_ground(0);
    const RobotView& r = s.add("r", walker({flat_sole()}), {{0, 0, leg_length}, Quat::Identity()});
    const RobotView& ball = s.add("ball", test::ball(0.2, 0.05, 0, 1), {{0.25, hip_spacing, 0.06}, Quat::Identity()});
    s.world().set(s.world().object("r/right_lift"), keys::initial_joint_position, 0.0);
    s.use("motion.biped", 1000, {{&r, r.base()}},
          {{"feet", Names{"right_foot", "left_foot"}}, {"joints", std::string("position")}});
    s.use(motion, 1000, {{&ball, ball.base()}});
    s.use_contacts();
    s.build();
    double fastest = 0, foot_speed = 0;
    for (int k = 1; k <= 400; ++k) {
      const double t = k * 0.001;
      s.world().value("r/left_lift", keys::joint_position_target) = 0.03 * std::min(1.0, t / 0.1);
      const double swing = std::max(0.0, t - 0.1) * 4;  // rad/s
      s.world().value("r/left_hip", keys::joint_position_target) = -std::min(swing, 0.9);
      s.world().value("r/left_ankle", keys::joint_position_target) = std::min(swing, 0.9);
      const double before = s.twist(ball).linear.x();
      s.run_for(0.001);
      s.refresh();
      if (before < 0.1 && s.twist(ball).linear.x() > 0.1)
        foot_speed = s.world().value("r/left_foot", keys::twist).linear.x();
      fastest = std::max(fastest, s.twist(ball).linear.x());
    }
    EXPECT_GT(foot_speed, 0.8) << motion << ": (l - c) 4 rad/s cos q";
    EXPECT_GT(fastest, 0.9 * foot_speed) << motion;
    EXPECT_LT(fastest, 2.1 * foot_speed) << motion << ": 2 v after an elastic impact with what is moved by no force";
    EXPECT_LT((s.pose(r).position - Vec3(0, 0, leg_length)).norm(), 1e-12) << "and is not pushed";
  }
}

TEST(ABiped, FeelsTheAccelerationOfItsArcAndNoSpikeAtAStep) {
  Compass legs;
  legs.period = 2 * legs.a;  // 1 rad/s
  const double dt = legs.period / 400;
  test::Scene s;
  s.add_ground();
  const RobotView& r = s.add("r", walker({flat_sole()}), {{0, 0, 1}, Quat::Identity()});
  for (const auto& [joint, position] : legs.start())
    s.world().set(s.world().object("r/" + joint), keys::initial_joint_position, position);
  s.use("motion.biped", 1 / dt, s.all_robots(),
        {{"feet", Names{"left_foot", "right_foot"}}, {"joints", std::string("position")}});
  const ObjectId imu = s.add_sensor_object(r, "imu", r.base());
  s.use("sensor.imu", 1 / dt, {{&r, imu}});
  s.build();
  double largest = 0, jump = 0;
  for (int k = 1; k <= 1200; ++k) {
    const double t = k * dt, part = t / legs.period - std::floor(t / legs.period + 1e-9);
    const bool left_stands = std::int64_t(std::floor(t / legs.period + 1e-9)) % 2 == 0;
    const double angle = legs.a * (2 * part - 1);
    for (const bool left : {true, false}) {
      const std::string leg = left ? "r/left_" : "r/right_";
      const double q = left == left_stands ? angle : -angle;
      s.world().value(leg + "hip", keys::joint_position_target) = q;
      s.world().value(leg + "ankle", keys::joint_position_target) = -q;
      s.world().value(leg + "lift", keys::joint_position_target) =
          left == left_stands ? 0 : legs.lift * std::sin(M_PI * part);
    }
    const Twist before = s.twist(r);
    s.run_for(dt);
    if (k < 3) continue;
    jump = std::max(jump, (s.twist(r).linear - before.linear).norm());
    const Vec3 f = s.world().value(imu, keys::linear_acceleration);  // value of the step before
    const double turned = (k - 1) % 400;
    if (turned < 2 || turned > 398) {  // the hips turn back: their velocity changes by 2 rad/s within a step
      continue;
    }
    largest = std::max(largest, (f - Vec3(0, 0, g)).norm());
  }
  EXPECT_NEAR(jump, 0.2052121, 2e-3) << "the velocity jumps at a step";
  EXPECT_NEAR(largest, leg_length, 1e-6) << "w^2 l towards the ankle is all that is felt";
}

TEST(ABiped, FeelsASmoothAccelerationRightThroughItsSteps) {
  // The legs swing as sines while feet come down: dv/dt would be hundreds of m/s^2 there.
  const double a = 0.35, lift = 0.03, omega = 2 * M_PI / 0.8, dt = 0.001;
  test::Scene s;
  s.add_ground();
  const RobotView& r = s.add("r", walker({flat_sole()}), {{0, 0, 1}, Quat::Identity()});
  s.use("motion.biped", 1 / dt, s.all_robots(),
        {{"feet", Names{"left_foot", "right_foot"}}, {"joints", std::string("position")}});
  const ObjectId imu = s.add_sensor_object(r, "imu", r.base());
  s.use("sensor.imu", 1 / dt, {{&r, imu}});
  s.build();
  double largest = 0;
  std::uint64_t steps = 0;
  for (int k = 1; k <= 4000; ++k) {
    const double t = k * dt, q = a * std::sin(omega * t), c = 0.5 * lift * (1 + std::sin(omega * t + 0.8));
    for (const bool left : {true, false}) {
      const std::string leg = left ? "r/left_" : "r/right_";
      s.world().value(leg + "hip", keys::joint_position_target) = left ? q : -q;
      s.world().value(leg + "ankle", keys::joint_position_target) = left ? -q : q;
      s.world().value(leg + "lift", keys::joint_position_target) = left ? c : lift - c;
    }
    s.run_for(dt);
    if (k > 3) largest = std::max(largest, (s.world().value(imu, keys::linear_acceleration) - Vec3(0, 0, g)).norm());
    steps = s.world().value(r.base(), own::stance_footholds);
  }
  EXPECT_GT(steps, 8u);
  const double tangential = leg_length * a * omega * omega, radial = leg_length * a * a * omega * omega;
  EXPECT_LT(largest, tangential + radial + lift * omega * omega);
  EXPECT_GT(largest, 0.8 * tangential);
}

TEST(ABiped, MovesEvenlyBetweenTargetsOfASlowerController) {
  Walk w(1000, {{"interpolate", 0.01}});
  for (int k = 1; k <= 20; ++k) {
    w.set("left_yaw", 0.01 * k);  // 1 rad/s at 100 Hz
    for (int i = 1; i <= 10; ++i) {
      w.run_for(0.001);
      ASSERT_NEAR(w.world().value("r/left_yaw", keys::joint_velocity), 1, 1e-9);
      ASSERT_NEAR(w.world().value("r/left_yaw", keys::joint_position), 0.01 * (k - 1) + 0.001 * i, 1e-12);
    }
  }
  EXPECT_NEAR(yaw_of(w.base().orientation), -0.2, 1e-12) << "the stance foot stays where it is";
  EXPECT_LT((w.twist(w.robot).angular - Vec3(0, 0, -1)).norm(), 1e-9);
}

TEST(ABiped, StandsStillWhereItsFootMeetsAWallIfItIsToldTo) {
  for (const bool stop : {false, true}) {
    test::Scene s;
    s.add_ground();
    const Shape wall = Shape::box({0.1, 2, 1});
    s.world().add_scenery("wall", {{0.25, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
    s.add("r", walker({flat_sole()}), {{0, 0, 1}, Quat::Identity()});
    s.world().set(s.world().object("r/left_lift"), keys::initial_joint_position, 0.02);
    s.use("motion.biped", 1000, s.all_robots(),
          {{"feet", Names{"left_foot", "right_foot"}},
           {"joints", std::string("velocity")},
           {"on_contact", std::string(stop ? "stop" : "ignore")}});
    s.use_contacts();
    s.build();
    const auto swing = [&](double rate, double seconds) {
      s.world().value("r/left_hip", keys::joint_velocity_target) = -rate;
      s.world().value("r/left_ankle", keys::joint_velocity_target) = rate;
      s.run_for(seconds);
      s.refresh();
      return s.world().value("r/left_foot", keys::pose).position.x() + 0.5 * foot_length;
    };
    const double toe = swing(0.5, 2);
    EXPECT_NEAR(toe, stop ? 0.2 : (leg_length - 0.02) * std::sin(1.0) + 0.5 * foot_length, 1e-2);
    EXPECT_NEAR(swing(-0.5, 0.2), toe - 0.1 * 0.25, 0.012) << "it can swing back";
  }
}

}  // namespace
}  // namespace muro::biped::testing
