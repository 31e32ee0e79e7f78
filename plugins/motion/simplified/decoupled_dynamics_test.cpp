// SPDX-License-Identifier: MIT
#include "decoupled_dynamics.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/joint_inertia.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::simplified {
namespace {

const Vec3 gravity(0, 0, -9.81);

Link frame(std::int32_t parent, JointKind joint, const Vec3& offset, const Vec3& axis) {
  Link f;
  f.parent = parent, f.joint = joint, f.origin.position = offset, f.axis = axis;
  return f;
}

/// A trunk with a shoulder, a fixed bracket on the arm, an elbow, a finger that mimics the elbow, and a slide.
struct Arm {
  std::vector<Link> links{Link{},
                          frame(0, JointKind::revolute, {0.1, 0, 0.2}, Vec3::UnitY()),
                          frame(1, JointKind::fixed, {0.2, 0.1, 0}, Vec3::UnitX()),
                          frame(1, JointKind::revolute, {0.4, 0, 0}, Vec3::UnitZ()),
                          frame(3, JointKind::revolute, {0.3, 0, 0}, Vec3::UnitZ()),
                          frame(0, JointKind::prismatic, {0, 0.2, 0}, Vec3(0, 0.6, 0.8))};
  std::vector<Inertia> inertias{{.mass = 5, .com = {0.02, 0.01, 0.1}, .ixx = 0.1, .iyy = 0.12, .izz = 0.08},
                                {.mass = 1.5, .com = {0.2, 0, 0}, .ixx = 0.001, .iyy = 0.02, .izz = 0.02},
                                {.mass = 0.4, .ixx = 0.001, .iyy = 0.001, .izz = 0.001},
                                {.mass = 1, .com = {0.15, 0, 0}, .ixx = 0.001, .iyy = 0.01, .izz = 0.01},
                                {.mass = 0.2, .com = {0.05, 0, 0}, .ixx = 1e-4, .iyy = 2e-4, .izz = 2e-4},
                                {.mass = 2, .com = {0, 0, 0.05}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01}};
  std::vector<double> q{0, 0.4, 0, -0.7, 0.1 - 0.5 * -0.7, 0.15};
  std::vector<std::uint32_t> dofs{1, 3, 5};

  Arm() { links[4].mimic = 3, links[4].mimic_multiplier = -0.5, links[4].mimic_offset = 0.1; }

  void turn(std::size_t joint, double by) {
    q[joint] += by;
    if (joint == 3) q[4] -= 0.5 * by;
  }
  std::vector<Pose> poses() const {
    std::vector<Pose> all(links.size());
    for (std::size_t i = 1; i < all.size(); ++i)
      all[i] = all[std::size_t(links[i].parent)] * pose_in_parent(links[i], q[i]);
    return all;
  }
  double mass() const {
    double m = 0;
    for (const Inertia& i : inertias) m += i.mass;
    return m;
  }
  Vec3 com() const { return composite_inertia(links, inertias, q).com; }
  /// Returns the derivative of `value` by the position of `joint`, by central differences.
  template <class Value>
  auto slope(std::size_t joint, Value value) {
    const double e = 1e-5;
    turn(joint, e);
    const auto above = value();
    turn(joint, -2 * e);
    const auto below = value();
    turn(joint, e);
    using Result = std::decay_t<decltype(above)>;
    return Result((above - below) / (2 * e));
  }
};

TEST(DecoupledDynamics, InertiasAreThoseOfTheKineticEnergy) {
  Arm arm;
  DecoupledDynamics dynamics(arm.links, arm.inertias, arm.dofs, true);
  dynamics.update({}, {}, arm.q, gravity);
  for (const DecoupledDynamics::Dof& dof : dynamics.dofs()) {
    double energy2 = 0;
    for (std::size_t i = 0; i < arm.links.size(); ++i) {
      const Vec3 v = arm.slope(dof.link, [&] { return Vec3(arm.poses()[i] * arm.inertias[i].com); });
      const Mat3 turn = arm.poses()[i].orientation.toRotationMatrix();
      const Mat3 rate = arm.slope(dof.link, [&] { return arm.poses()[i].orientation.toRotationMatrix(); });
      const Mat3 spin = rate * turn.transpose();  // skew
      const Vec3 w = turn.transpose() * Vec3(spin(2, 1), spin(0, 2), spin(1, 0));
      energy2 += arm.inertias[i].mass * v.squaredNorm() + w.dot(arm.inertias[i].tensor() * w);
    }
    EXPECT_NEAR(dof.inertia, energy2, 1e-8);
    EXPECT_NEAR(dof.inertia, joint_inertia(arm.links, arm.inertias, arm.q, dof.link), 1e-14);
  }
}

TEST(DecoupledDynamics, WeightActsByTheSlopeOfThePotentialEnergy) {
  Arm arm;
  DecoupledDynamics dynamics(arm.links, arm.inertias, arm.dofs, true);
  const Pose base{{1, 2, 3}, from_rpy(0.5, -0.3, 2)};
  dynamics.update(base, {}, arm.q, gravity);
  for (const DecoupledDynamics::Dof& dof : dynamics.dofs())
    EXPECT_NEAR(dof.force, arm.slope(dof.link, [&] { return arm.mass() * gravity.dot(base * arm.com()); }), 1e-8);
}

TEST(DecoupledDynamics, AWrenchActsByThePowerThatItHas) {
  Arm arm;
  DecoupledDynamics dynamics(arm.links, arm.inertias, arm.dofs, true);
  const Wrench wrench{{3, -4, 5}, {0.2, 0.3, -0.5}};
  const void* slots[] = {&wrench};
  const SumHeader sum{slots, 1};
  dynamics.add_wrench(4, SumIn<Wrench>(&sum));
  const Pose base{{1, 2, 3}, from_rpy(0.5, -0.3, 2)};
  const Wrench all = dynamics.update(base, {}, arm.q, Vec3::Zero());
  const Vec3 at = base * arm.poses()[4].position;
  EXPECT_LT((all.force - wrench.force).norm(), 1e-14);
  EXPECT_LT((all.torque - wrench.torque - (at - base.position).cross(wrench.force)).norm(), 1e-13);
  for (const DecoupledDynamics::Dof& dof : dynamics.dofs()) {
    const Vec3 v = arm.slope(dof.link, [&] { return Vec3(base * arm.poses()[4].position); });
    const Mat3 turn = (base * arm.poses()[4]).orientation.toRotationMatrix();
    const Mat3 spin =
        arm.slope(dof.link, [&] { return (base * arm.poses()[4]).orientation.toRotationMatrix(); }) * turn.transpose();
    const Vec3 w(spin(2, 1), spin(0, 2), spin(1, 0));
    EXPECT_NEAR(dof.force, wrench.force.dot(v) + wrench.torque.dot(w), 1e-8);
  }
}

TEST(DecoupledDynamics, InFreeFallNothingHangsDown) {
  Arm arm;
  DecoupledDynamics dynamics(arm.links, arm.inertias, arm.dofs, false);
  dynamics.update({{1, 2, 3}, from_rpy(0.5, -0.3, 2)}, {}, arm.q, gravity);
  for (const DecoupledDynamics::Dof& dof : dynamics.dofs()) EXPECT_NEAR(dof.force, 0, 1e-12);
}

TEST(DecoupledDynamics, AFreeBaseGivesWayToTheMomentumOfAJoint) {
  Arm arm;
  DecoupledDynamics free(arm.links, arm.inertias, arm.dofs, false), fixed(arm.links, arm.inertias, arm.dofs, true);
  free.update({}, {}, arm.q, gravity);
  fixed.update({}, {}, arm.q, gravity);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 com = arm.slope(free.dofs()[k].link, [&] { return arm.com(); });
    EXPECT_NEAR(free.dofs()[k].inertia, fixed.dofs()[k].inertia - arm.mass() * com.squaredNorm(), 1e-8);
  }
  // Two masses and a slide between them: the reduced mass.
  const std::vector<Link> links{Link{}, frame(0, JointKind::prismatic, Vec3::Zero(), Vec3::UnitX())};
  const std::vector<Inertia> two{{.mass = 3, .ixx = 1, .iyy = 1, .izz = 1}, {.mass = 2}};
  const std::vector<std::uint32_t> slide{1};
  DecoupledDynamics pair(links, two, slide, false);
  pair.update({}, {}, std::vector<double>{0, 0.4}, Vec3::Zero());
  EXPECT_NEAR(pair.dofs()[0].inertia, 3 * 2 / 5.0, 1e-14);
}

TEST(DecoupledDynamics, AWheelIsTheSameHoweverItHasTurned) {
  // `other` is not treated as a wheel, because its link carries a link without mass.
  std::vector<Link> links{Link{}, frame(0, JointKind::revolute, {0.1, 0.2, 0}, Vec3::UnitY())};
  std::vector<Inertia> inertias{{.mass = 4, .com = {0, 0, 0.1}, .ixx = 0.1, .iyy = 0.2, .izz = 0.3},
                                {.mass = 0.3, .com = {0, 0.01, 0}, .ixx = 3e-4, .iyy = 5e-4, .izz = 3e-4}};
  const std::vector<std::uint32_t> dof{1};
  DecoupledDynamics wheel(links, inertias, dof, false);
  links.push_back(frame(1, JointKind::revolute, {0.05, 0, 0}, Vec3::UnitX()));
  inertias.emplace_back();
  DecoupledDynamics other(links, inertias, dof, false);
  const Wrench wrench{{3, -4, 5}, {0.2, 0.3, -0.5}};
  const void* slots[] = {&wrench};
  const SumHeader sum{slots, 1};
  wheel.add_wrench(1, SumIn<Wrench>(&sum));
  other.add_wrench(1, SumIn<Wrench>(&sum));
  const Pose base{{1, 2, 3}, from_rpy(0.5, -0.3, 2)};
  const Twist twist{{1, 0, 0}, {1, 2, 3}};
  const Wrench a = wheel.update(base, twist, std::vector<double>{0, 0}, gravity);
  const Wrench b = other.update(base, twist, std::vector<double>{0, 1.3, 0}, gravity);
  EXPECT_NEAR(wheel.dofs()[0].force, other.dofs()[0].force, 1e-13);
  EXPECT_NEAR(wheel.dofs()[0].inertia, other.dofs()[0].inertia, 1e-17);
  EXPECT_LT((a.torque - b.torque).norm(), 1e-13);
}

TEST(DecoupledDynamics, ASpinningBaseThrowsASlideOut) {
  // Centrifugal force m w^2 r of a mass on a radial slide; a heavy base, so that its centre of mass stays.
  const std::vector<Link> links{Link{}, frame(0, JointKind::prismatic, {0.1, 0, 0}, Vec3::UnitX())};
  const std::vector<Inertia> masses{{.mass = 1e9, .ixx = 1e9, .iyy = 1e9, .izz = 1e9}, {.mass = 2}};
  const std::vector<std::uint32_t> slide{1};
  DecoupledDynamics dynamics(links, masses, slide, false);
  dynamics.update({{}, from_rpy(0, 0, 1)}, {{}, {0, 0, 3}}, std::vector<double>{0, 0.4}, Vec3::Zero());
  EXPECT_NEAR(dynamics.dofs()[0].force, 2 * 9 * 0.5, 1e-6);
}

TEST(DecoupledDynamics, ABaseThatIsPushedLeavesAPendulumBehind) {
  // A point mass on a rod, straight down, under a heavy base that accelerates with 2 m/s^2 along x: - m l a.
  const std::vector<Link> links{Link{}, frame(0, JointKind::revolute, Vec3::Zero(), -Vec3::UnitY())};
  const std::vector<Inertia> masses{{.mass = 1e9, .ixx = 1e9, .iyy = 1e9, .izz = 1e9},
                                    {.mass = 2, .com = {0, 0, -0.5}, .ixx = 1e-6, .iyy = 1e-6, .izz = 1e-6}};
  const std::vector<std::uint32_t> pivot{1};
  DecoupledDynamics dynamics(links, masses, pivot, false);
  const Wrench push{{2e9, 0, 0}, {0, 0, 0}};
  const void* slots[] = {&push};
  const SumHeader sum{slots, 1};
  dynamics.add_wrench(0, SumIn<Wrench>(&sum));
  dynamics.update({}, {}, std::vector<double>{0, 0}, Vec3::Zero());
  EXPECT_NEAR(dynamics.dofs()[0].force, -2 * 0.5 * 2, 1e-6);
}

}  // namespace
}  // namespace muro::simplified
