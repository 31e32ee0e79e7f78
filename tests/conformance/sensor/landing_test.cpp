// SPDX-License-Identifier: MIT
// Forces that change from step to step: the readings of force-torque sensor and accelerometer must fit together.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {
namespace {

/// A trunk of 3 kg on a foot of 0.5 kg, with the sensor between them, and an accelerometer at the centre of the trunk.
struct Lander : test::Scene {
  static constexpr double trunk_mass = 3, foot_mass = 0.5;
  ObjectId wrench{}, acceleration{};

  /// `bystander`: rate (Hz) of a motion of another robot, for which contacts are searched in between; 0: none.
  Lander(const std::string& motion, const Pose& start, const Twist& twist, double restitution, double rate,
         double bystander = 0) {
    const Shape sole = test::with(Shape::box({0.3, 0.2, 0.04}), 0.8, restitution);
    add_ground();
    const RobotView& r = add("r", test::tree_of([&](RobotBuilder& b) {
                               b.base("trunk");
                               b.set(keys::inertial, test::solid_box(trunk_mass, {0.2, 0.2, 0.3}));
                               b.translation({0, 0, -0.2});
                               b.body("foot");
                               b.set(keys::inertial, test::solid_box(foot_mass, {0.3, 0.2, 0.04}));
                               b.set_array(keys::collision_shapes, std::span<const Shape>(&sole, 1));
                             }),
                             start, twist);
    wrench = add_sensor_object(r, "joint", world().object("r/foot"));
    acceleration = add_sensor_object(r, "accelerometer", r.base());
    use(motion, 1000, {{&r, r.base()}});
    if (bystander > 0) {
      const RobotView& other = add("other", test::ball(1, 0.1, 0.5), {{3, 0, 0.1}, Quat::Identity()});
      use("motion.simplified", bystander, {{&other, other.base()}});
    }
    use("sensor.force_torque", rate, {{&r, wrench}});
    use("sensor.accelerometer", rate, {{&r, acceleration}});
    use_contacts();
    build();
  }
  /// Returns the force on the trunk, which only the foot touches, less the trunk's mass times its specific force.
  Vec3 missing() {
    const Vec3 force = world().value(wrench, keys::sensed_wrench).force;
    return force - trunk_mass * world().value(acceleration, keys::linear_acceleration);
  }
  double force() { return world().value(wrench, keys::sensed_wrench).force.norm(); }
};

/// A flat landing with an impact, a tilted one with several, and one so soft that springs carry it.
struct Landing {
  const char* name;
  Pose start;
  Twist twist;
  double restitution;
};
const Landing landings[] = {
    {"flat", {{0, 0, 0.3}, Quat::Identity()}, {{0, 0, -1}, Vec3::Zero()}, 0.3},
    {"tilted", {{0, 0, 0.35}, from_rpy(0.3, 0.2, 0)}, {{0.5, 0, -1}, {0.3, -0.2, 1}}, 0.2},
    {"softly", {{0, 0, 0.2225}, Quat::Identity()}, Twist{}, 0},
};

TEST(ForceTorqueSensor, ReadsMassTimesSpecificForceInALanding) {
  for (const Landing& landing : landings)
    for (const auto& [rate, bystander] : {std::pair(1000.0, 0.0), {250.0, 0.0}, {1000.0, 4000.0}}) {
      Lander s("motion.simplified", landing.start, landing.twist, landing.restitution, rate, bystander);
      double worst = 0, largest = 0;
      s.run_for(0.0005);
      for (int k = 0; k < 400; ++k) {
        worst = std::max(worst, s.missing().norm());
        largest = std::max(largest, s.force());
        s.run_for(0.001);
      }
      EXPECT_LT(worst, 1e-9 * std::max(1.0, largest)) << landing.name << ", " << rate << " Hz";
      EXPECT_GT(largest, 1.05 * s.trunk_mass * g) << landing.name << ": it has landed";
    }
}

/// Contacts of engines act during a whole step, and accelerations follow from its two ends.
TEST(ForceTorqueSensor, ReadsMassTimesSpecificForceAtEngines) {
  const std::pair<const char*, double> engines[] = {
      {"motion.articulated", 1e-9}, {"motion.mujoco", 1e-6}, {"motion.bullet", 1e-6}, {"motion.ode", 1e-6}};
  for (const auto& [motion, bound] : engines) {
    Lander s(motion, landings[0].start, landings[0].twist, 0.3, 1000);
    double worst = 0, largest = 0;
    s.run_for(0.0005);
    for (int k = 0; k < 400; ++k) {
      worst = std::max(worst, s.missing().norm());
      largest = std::max(largest, s.force());
      s.run_for(0.001);
    }
    EXPECT_LT(worst, bound * largest) << motion;
    EXPECT_GT(largest, 10 * s.trunk_mass * g) << motion << ": it has landed";
  }
}

/// Checks a robot of motion.simplified that lands on a robot of another motion, which has the sensor.
TEST(ForceTorqueSensor, FeelsWhatLandsInTheStepInWhichItActs) {
  for (const char* motion :
       {"motion.simplified", "motion.articulated", "motion.mujoco", "motion.bullet", "motion.ode"}) {
    test::Scene s;
    const Shape tray = test::with(Shape::box({0.4, 0.4, 0.04}), 0.8);
    s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const RobotView& r = s.add("r", test::tree_of([&](RobotBuilder& b) {
                                 b.base("trunk");
                                 b.set(keys::inertial, test::solid_box(3, {0.3, 0.3, 0.3}));
                                 b.translation({0, 0, 0.3});
                                 b.body("tray");
                                 b.set(keys::inertial, test::solid_box(0.5, {0.4, 0.4, 0.04}));
                                 b.set_array(keys::collision_shapes, std::span<const Shape>(&tray, 1));
                               }),
                               {});
    const RobotView& ball =
        s.add("ball", test::ball(1, 0.1, 0), {{0, 0, 0.45}, Quat::Identity()}, {{0, 0, -1}, Vec3::Zero()});
    const ObjectId joint = s.add_sensor_object(r, "joint", s.world().object("r/tray"));
    const ObjectId acceleration = s.add_sensor_object(r, "accelerometer", r.base());
    s.use(motion, 1000, {{&r, r.base()}});
    s.use("motion.simplified", 1000, {{&ball, ball.base()}});
    s.use("sensor.force_torque", 1000, {{&r, joint}});
    s.use("sensor.accelerometer", 1000, {{&r, acceleration}});
    s.use_contacts();
    s.build();
    s.run_for(0.0005);
    double worst = 0, largest = 0;
    for (int k = 0; k < 60; ++k) {
      const Vec3 force = s.world().value(joint, keys::sensed_wrench).force;
      worst = std::max(worst, Vec3(force - 3 * s.world().value(acceleration, keys::linear_acceleration)).norm());
      largest = std::max(largest, force.norm());
      s.run_for(0.001);
    }
    EXPECT_LT(worst, 1e-9 * largest) << motion;
    EXPECT_GT(largest, 10) << motion;
  }
}

}  // namespace
}  // namespace muro::sensor_conformance
