// SPDX-License-Identifier: MIT
// Tests of the solver that motion.ode chooses, and of the robots that it must hold. Tests for every motion are in
// tests/conformance.
#include <gtest/gtest.h>

#include <cmath>

#include "quick_convergence.hpp"
#include "tests/support/bodies.hpp"

namespace muro::ode {
namespace {

using multibody::RigidBody, multibody::RobotModel;
using test::solid_box;

RigidBody link(std::int32_t parent, const Vec3& offset, const Inertia& inertia) {
  RigidBody body;
  body.parent = parent;
  if (parent >= 0) body.joint = JointKind::revolute;
  body.axis = Vec3::UnitY();
  body.origin.position = offset;
  body.inertia = inertia;
  return body;
}

/// A base with `count` wheels.
RobotModel vehicle(int count, double wheel_mass) {
  RobotModel model;
  model.bodies.push_back(link(-1, Vec3::Zero(), solid_box(4, {0.5, 0.4, 0.1})));
  for (int i = 0; i < count; ++i)
    model.bodies.push_back(
        link(0, Vec3(i % 2 == 0 ? 0.2 : -0.2, i < 2 ? 0.2 : -0.2, 0), solid_box(wheel_mass, {0.1, 0.04, 0.1})));
  model.initial_positions.resize(model.bodies.size());
  return model;
}

/// A chain of links of 1 kg, with `tip` (kg) at the end.
RobotModel chain(int count, double tip) {
  RobotModel model;
  model.bodies.push_back(link(-1, Vec3::Zero(), solid_box(1, {0.1, 0.1, 0.1})));
  for (int i = 0; i < count; ++i)
    model.bodies.push_back(link(i, Vec3(0, 0, 0.2), solid_box(i + 1 < count ? 1 : tip, {0.05, 0.05, 0.2})));
  model.initial_positions.resize(model.bodies.size());
  return model;
}

TEST(QuickConvergence, IsThatOfWheelsAndNotThatOfChains) {
  EXPECT_LT(unsolved_part(vehicle(4, 0.3), 50), 1e-4);
  EXPECT_EQ(unsolved_part(vehicle(0, 0.3), 50), 0);
  EXPECT_GT(unsolved_part(chain(20, 1), 50), 1e-3);
  EXPECT_GT(unsolved_part(chain(6, 1000), 50), 1e-3) << "a heavy body on light ones";
  EXPECT_LT(unsolved_part(chain(20, 1), 5000), 1e-3) << "many iterations do it";
  EXPECT_GT(unsolved_part(chain(20, 1), 10), unsolved_part(chain(20, 1), 100));
}

/// A wall of 1 kg with handles of 64 g far from its middle, each on a stiff hinge, like a wall with valves.
RobotTree valve_wall() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("wall");
    Inertia inertia{.mass = 1, .ixx = 1, .iyy = 1, .izz = 1};
    inertia.com = {0.6, 0.1, 1.2};
    b.set(keys::inertial, inertia);
    Shape box = Shape::box({1.2, 0.1, 2.4});
    box.origin.position = inertia.com;
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
    const JointLimits limits{.lower = -12.56, .upper = 12.56, .effort = 1e9, .damping = 10, .friction = 10};
    constexpr int handles = 11;
    for (int i = 0; i < handles; ++i) {
      if (i + 1 < handles) b.fork();
      b.translation({0.3 + 0.3 * (i % 3), -0.02, 0.3 + 0.6 * std::floor(i / 3.0)});
      b.revolute("joint_" + std::to_string(i), Vec3::UnitY(), limits);
      b.body("handle_" + std::to_string(i));
      b.set(keys::inertial, Inertia{.mass = 0.0644, .ixx = 3.1e-5, .iyy = 3.1e-5, .izz = 5.9e-5});
      if (i + 1 < handles) b.end();
    }
    for (int i = 0; i + 1 < handles; ++i) b.end();
  });
}

TEST(OdeSolver, LightLinksFarFromTheBodyThatHoldsThemStayOnIt) {
  // iterations throw the handles away at kilometres per second
  test::Scene s;
  s.add_ground(0.8);
  const RobotView& r = s.add("wall", valve_wall(), {{0, 0, 0.5}, Quat::Identity()});
  s.use("motion.ode", 1000, s.all_robots());
  s.use_contacts();
  s.build();
  double fastest = 0;
  for (int k = 0; k < 200; ++k) {
    s.run_for(0.01);
    fastest = std::max(fastest, s.twist(r).linear.norm());
    for (int i = 0; i < 11; ++i)
      EXPECT_LT(std::abs(s.world().value("wall/joint_" + std::to_string(i), keys::joint_velocity)), 1);
  }
  EXPECT_LT(fastest, 8);  // it falls over: its top comes down with sqrt(3 g 2.4 m)
  EXPECT_LT(s.twist(r).linear.norm(), 0.1);
}

/// A box of 1 kg with three arms of 12 g. The rotors of their servos have a thousand times the inertia of an arm.
RobotTree servos() {
  return test::tree_of([](RobotBuilder& b) {
    const Shape box = Shape::box({0.1, 0.1, 0.1});
    b.base("box");
    b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.003, .iyy = 0.003, .izz = 0.003});
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
    const Vec3 axes[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
    for (int i = 0; i < 3; ++i) {
      b.fork();
      b.translation({0.05 * (i - 1), 0.02, 0.06});
      b.revolute("joint_" + std::to_string(i), axes[i],
                 {.lower = -1, .upper = 1, .velocity = 5, .effort = 4, .damping = 0.004, .armature = 0.003});
      b.body("arm_" + std::to_string(i));
      Inertia inertia{.mass = 0.012, .ixx = 3e-6, .iyy = 3e-6, .izz = 3e-6};
      inertia.com = {0.03, 0, 0};
      b.set(keys::inertial, inertia);
      b.end();
    }
    for (int i = 0; i < 3; ++i) b.end();
  });
}

struct Servos : test::Scene {
  explicit Servos(const char* solver, const char* joints, double height) {
    add_ground(0.8);
    robot = &add("r", servos(), {{0, 0, height}, Quat::Identity()});
    use("motion.ode", 1000, all_robots(), {{"solver", std::string(solver)}, {"joints", std::string(joints)}});
    use_contacts();
    build();
  }
  double& joint(int i, const Key<double>& key) { return world().value("r/joint_" + std::to_string(i), key); }
  double fastest_joint() {
    double fastest = 0;
    for (int i = 0; i < 3; ++i) fastest = std::max(fastest, std::abs(joint(i, keys::joint_velocity)));
    return fastest;
  }
  const RobotView* robot = nullptr;
};

TEST(OdeSolver, IterationsGiveHeavyRotorsNoEnergy) {
  const double all_in_one = std::sqrt(2 * 1.036 * 9.81 * 0.05 / 0.003);  // rad/s: of a rotor, by a fall of 5 cm
  for (const char* joints : {"velocity", "passive"}) {
    Servos s("quick", joints, 0.1);
    for (int k = 0; k < 200; ++k) {
      s.run_for(0.01);
      ASSERT_LT(s.fastest_joint(), all_in_one) << joints;
      ASSERT_LT(s.twist(*s.robot).linear.norm(), 1.1) << joints;
    }
    EXPECT_LT(s.fastest_joint(), 0.02) << joints;
    EXPECT_NEAR(s.pose(*s.robot).position.z(), 0.05, 1e-3) << joints;
  }
}

TEST(OdeSolver, IterationsMoveHeavyRotorsAsTheExactSolverDoes) {
  Servos quick("quick", "effort", 5), exact("exact", "effort", 5);
  for (Servos* s : {&quick, &exact}) {
    for (int i = 0; i < 3; ++i) s->joint(i, keys::joint_effort_target) = 0.004 * (i + 1);
    s->run_for(0.5);
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(quick.joint(i, keys::joint_position) / exact.joint(i, keys::joint_position), 1, 5e-3) << i;
}

TEST(OdeSolver, TheSoftnessOfContactIsThatOfTheMass) {
  // Each of four corners carries m g / 4 with the effective mass m / 4: erp depth / h = softness h (4 / m) (m g / 4).
  for (const double mass : {1e-3, 1.0, 1e3, 1e6}) {
    test::Scene s;
    s.add_ground(0.8);
    const RobotView& r = s.add("box", test::block(mass, {0.2, 0.2, 0.2}, 0.8), {{0, 0, 0.1}, Quat::Identity()});
    s.use("motion.ode", 1000, s.all_robots(), {{"softness", 0.1}});
    s.use_contacts();
    s.build();
    s.run_for(1);
    EXPECT_NEAR(0.1 - s.pose(r).position.z(), 0.1 * 1e-6 * 9.81 / 0.2, 1e-9) << mass;
  }
}

}  // namespace
}  // namespace muro::ode
