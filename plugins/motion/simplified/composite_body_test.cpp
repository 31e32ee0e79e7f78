// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "composite_body.hpp"

namespace muro::simplified {
namespace {

Link frame_of(int parent, JointKind joint, const Vec3& offset, const Vec3& axis) {
  Link f;
  f.parent = parent;
  f.joint = joint;
  f.origin.position = offset;
  f.axis = axis;
  return f;
}

/// A double pendulum: a base at the origin and two slender links (mass m, length l) in the xz plane that turn about y
/// and hang along -z at zero.
struct TwoLinks {
  double base_mass = 3, m = 2, l = 0.5;
  std::vector<Link> links{frame_of(-1, JointKind::fixed, {0, 0, 0}, Vec3::UnitX()),
                          frame_of(0, JointKind::revolute, {0, 0, 0}, Vec3::UnitY()),
                          frame_of(1, JointKind::revolute, {0, 0, -0.5}, Vec3::UnitY())};
  std::vector<Inertia> inertias{
      {.mass = base_mass, .com = Vec3::Zero(), .ixx = 0.1, .iyy = 0.2, .izz = 0.3},
      {.mass = m, .com = {0, 0, -l / 2}, .ixx = m * l * l / 12, .iyy = m * l * l / 12, .izz = 1e-9},
      {.mass = m, .com = {0, 0, -l / 2}, .ixx = m * l * l / 12, .iyy = m * l * l / 12, .izz = 1e-9}};
  std::vector<double> start{0, 0, 0};
};

Vec3 hand(double a, double b, const TwoLinks& t) {  // centre of mass by hand
  const Vec3 first = Vec3(-std::sin(a), 0, -std::cos(a)), second = Vec3(-std::sin(a + b), 0, -std::cos(a + b));
  return (t.m * 0.5 * t.l * first + t.m * (t.l * first + 0.5 * t.l * second)) / (t.base_mass + 2 * t.m);
}

TEST(CompositeBody, FollowsTwoLinksAsInTheClosedForm) {
  const TwoLinks t;
  CompositeBody mass(t.links, t.inertias, t.start);
  ASSERT_EQ(mass.joints().size(), 2u);
  EXPECT_EQ(mass.mass(), 7);
  for (const auto& [a, b] : {std::pair{0.0, 0.0}, {0.3, -0.8}, {2.0, 1.0}, {-1.2, 0.4}}) {
    const double q[] = {a, b}, rest[] = {0, 0};
    const MassState s = mass.state(q, rest);
    EXPECT_LT((s.com - hand(a, b, t)).norm(), 1e-14);
    // about y: sum of own moments and mass times distance squared to the common centre
    const Vec3 first(-std::sin(a), 0, -std::cos(a)), second(-std::sin(a + b), 0, -std::cos(a + b));
    const double own = 0.2 + 2 * t.m * t.l * t.l / 12;
    const double moment = own + t.base_mass * s.com.squaredNorm() + t.m * (0.5 * t.l * first - s.com).squaredNorm() +
                          t.m * (t.l * first + 0.5 * t.l * second - s.com).squaredNorm();
    EXPECT_NEAR(s.tensor(1, 1), moment, 1e-14);
    EXPECT_LT((s.tensor - s.tensor.transpose()).norm(), 1e-15);
  }
}

TEST(CompositeBody, TheVelocityOfTheCentreIsItsDerivative) {
  TwoLinks t;
  t.links.push_back(frame_of(2, JointKind::prismatic, {0.1, 0.2, 0}, Vec3(1, 2, 2) / 3));
  t.inertias.push_back({.mass = 0.7, .com = {0.1, 0, 0.2}, .ixx = 0.01, .iyy = 0.02, .izz = 0.02});
  t.start.push_back(0);
  CompositeBody mass(t.links, t.inertias, t.start);
  const double q[] = {0.4, -1.1, 0.3}, rate[] = {1.5, -0.7, 0.9}, rest[] = {0, 0, 0}, h = 1e-6;
  double ahead[3], back[3];
  for (int k = 0; k < 3; ++k) ahead[k] = q[k] + h * rate[k], back[k] = q[k] - h * rate[k];
  const Vec3 difference = (mass.state(ahead, rest).com - mass.state(back, rest).com) / (2 * h);
  EXPECT_LT((mass.state(q, rate).com_velocity - difference).norm(), 1e-9);
}

TEST(CompositeBody, WheelsMoveNoMassButAnUnbalancedOneDoes) {
  std::vector<Link> links{frame_of(-1, JointKind::fixed, {0, 0, 0}, Vec3::UnitX())};
  std::vector<Inertia> inertias{{.mass = 4, .com = {0, 0, 0.02}, .ixx = 0.04, .iyy = 0.06, .izz = 0.09}};
  for (const double x : {-0.12, 0.12})
    for (const double y : {-0.15, 0.15}) {
      links.push_back(frame_of(0, JointKind::revolute, {x, y, -0.03}, Vec3::UnitY()));
      inertias.push_back({.mass = 0.3, .com = Vec3::Zero(), .ixx = 3.1e-4, .iyy = 5.4e-4, .izz = 3.1e-4});
    }
  const std::vector<double> start(5, 0.7);
  EXPECT_TRUE(CompositeBody(links, inertias, start).rigid());
  auto shifted = inertias;
  shifted[2].com = {0.001, 0, 0};
  EXPECT_EQ(CompositeBody(links, shifted, start).joints().size(), 1u);
  auto uneven = inertias;
  uneven[3].ixx = 4e-4;
  EXPECT_EQ(CompositeBody(links, uneven, start).joints().size(), 1u);
  auto tilted = inertias;
  tilted[4].ixy = 1e-5;
  EXPECT_EQ(CompositeBody(links, tilted, start).joints().size(), 1u);
}

TEST(CompositeBody, ABalancedWheelOnAMovingArmBelongsToTheArm) {
  TwoLinks t;
  t.links.push_back(frame_of(2, JointKind::revolute, {0, 0, -0.5}, Vec3::UnitY()));
  t.inertias.push_back({.mass = 1, .com = Vec3::Zero(), .ixx = 0.01, .iyy = 0.02, .izz = 0.01});
  t.start.push_back(0.4);
  CompositeBody mass(t.links, t.inertias, t.start);
  EXPECT_EQ(mass.joints().size(), 2u);
  EXPECT_EQ(mass.mass(), 8);
}

}  // namespace
}  // namespace muro::simplified
