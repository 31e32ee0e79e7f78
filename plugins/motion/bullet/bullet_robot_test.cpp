// SPDX-License-Identifier: MIT
#include "bullet_robot.hpp"

#include <gtest/gtest.h>

#include <random>

#include "invert_positive_definite.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::bullet {
namespace {

using multibody::RigidBody, multibody::RobotModel, multibody::RobotState;

RigidBody body(std::int32_t parent, JointKind joint, const Pose& origin, const Vec3& axis, const Inertia& inertia) {
  RigidBody b;
  b.parent = parent;
  b.joint = joint;
  b.origin = origin;
  b.axis = axis;
  b.inertia = inertia;
  return b;
}

/// A base with two arms, one of them with two links, one joint prismatic; no axes are aligned.
RobotModel crooked() {
  const Inertia odd{
      .mass = 2, .com = {0.1, -0.05, 0.2}, .ixx = 0.3, .iyy = 0.4, .izz = 0.5, .ixy = 0.05, .ixz = -0.02, .iyz = 0.1};
  RobotModel m;
  m.bodies.push_back(body(-1, JointKind::fixed, {}, Vec3::UnitX(), odd));
  m.bodies.push_back(
      body(0, JointKind::revolute, {{0.3, 0.1, 0}, from_rpy(0.2, 0.5, -0.3)}, Vec3(1, 2, 3).normalized(), odd));
  m.bodies.push_back(
      body(1, JointKind::prismatic, {{0, 0.2, 0.1}, from_rpy(-0.4, 0.1, 0.9)}, Vec3(0, 1, -1).normalized(), odd));
  m.bodies.push_back(body(0, JointKind::revolute, {{-0.2, 0, 0.3}, from_rpy(1, 0, 0.5)}, Vec3::UnitY(), odd));
  return m;
}

RobotState state_of(const RobotModel& m) {
  RobotState s;
  s.joints.resize(m.bodies.size());
  s.external.resize(m.bodies.size());
  s.pose = {{1, 2, 3}, from_rpy(0.3, -0.7, 2)};
  s.twist = {{0.4, -0.2, 0.1}, {1, 2, -1}};
  for (std::size_t i = 1; i < m.bodies.size(); ++i) {
    s.joints[i].position = 0.4 * double(i);
    s.joints[i].velocity = 1.5 - double(i);
  }
  return s;
}

TEST(ARobotInBullet, AnswersImpulsesAsBulletsPassOverItsLinksSays) {
  for (const bool fixed : {false, true}) {
    RobotModel m = crooked();
    m.fixed_base = fixed;
    RobotState s = state_of(m);
    BulletRobot r(m, s);
    ArticulatedBodyScratch scratch;
    r.update_kinematics();
    r.prepare({0, 0, -9.81}, 1e-3, scratch);
    for (int k = fixed ? 6 : 0; k < r.size(); ++k) {
      std::vector<double> force(std::size_t(r.size())), expected(std::size_t(r.size()));
      force[std::size_t(k)] = 1;
      r.bullet_body().calcAccelerationDeltasMultiDof(force.data(), expected.data(), scratch.numbers, scratch.vectors);
      for (int i = 0; i < r.size(); ++i)
        EXPECT_NEAR(r.inverse_inertia()(i, k), expected[std::size_t(i)], 1e-10)
            << i << ", " << k << (fixed ? " fixed" : "");
    }
  }
}

TEST(ARobotInBullet, HasRowsThatAreTheVelocitiesOfItsPoints) {
  const RobotModel m = crooked();
  RobotState s = state_of(m);
  BulletRobot r(m, s);
  ArticulatedBodyScratch scratch;
  r.update_kinematics();
  r.prepare(Vec3::Zero(), 1e-9, scratch);  // velocities do not change
  const Vec3 point(0.7, 1.2, 2.9), direction = Vec3(1, -2, 0.5).normalized();
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    std::vector<double> row(std::size_t(r.size()));
    r.add_jacobian(i, r.wrench(point, direction), 1, row.data());
    double speed = 0;
    for (int k = 0; k < r.size(); ++k) speed += row[std::size_t(k)] * r.velocity()[k];
    EXPECT_NEAR(speed, direction.dot(r.body_state(i).twist.at(point - r.body_state(i).pose.position)), 1e-6)
        << "body " << i;
  }
}

TEST(ARobotInBullet, KeepsItsMomentaWhenNothingTouchesIt) {
  RobotModel m = crooked();
  RobotState s = state_of(m);
  BulletRobot r(m, s);
  ArticulatedBodyScratch scratch;
  const auto momenta = [&] {
    std::vector<multibody::BodyState> parts(m.bodies.size());
    forward_kinematics(m, s, parts);
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Inertia& inertia = m.bodies[i].inertia;
      const Vec3 arm = parts[i].pose.orientation * inertia.com, p = inertia.mass * parts[i].twist.at(arm);
      const Mat3 axes = parts[i].pose.orientation.toRotationMatrix();
      sum.head<3>() += p;
      sum.tail<3>() +=
          (parts[i].pose.position + arm).cross(p) + axes * inertia.tensor() * axes.transpose() * parts[i].twist.angular;
    }
    return sum;
  };
  const auto before = momenta();
  for (int k = 0; k < 1000; ++k) {
    r.update_kinematics();
    r.prepare(Vec3::Zero(), 1e-4, scratch);
    std::copy_n(r.velocity(), r.size(), r.position_velocity());
    r.finish(Vec3::Zero(), 1e-4);
  }
  EXPECT_LT((momenta() - before).norm(), 2e-3 * before.norm()) << "first order in the step";
}

TEST(Inverting, GivesTheInverse) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int n : {1, 6, 10, 35}) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
    const Eigen::MatrixXd m = a * a.transpose() + Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd work = m, out(n, n);
    invert_positive_definite(work.data(), n, out.data(), n);
    EXPECT_LT((out * m - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-9) << n;
  }
}

}  // namespace
}  // namespace muro::bullet
