// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "friction_anchor.hpp"
#include "patch.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro::penalty {
namespace {

using Patch = law::Patch<double>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

using muro::plain;
law::Symmetric<double> plain(const Mat3& m) { return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}; }
Mat3 matrix_of(const law::Symmetric<double>& m) {
  return (Mat3() << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz).finished();
}

/// A law::Mobility in Eigen's types.
struct Mobility {
  double mass;
  Mat3 inertia;
  Vec3 centre;

  operator law::Mobility<double>() const { return {mass, plain(inertia), plain(centre)}; }
};

/// Returns the velocity that a unit impulse along `direction` at `point` gives the point, by rigid-body mechanics.
Vec3 response(const Mobility& b, const Vec3& point, const Vec3& direction) {
  const Vec3 r = point - b.centre, spin = b.inertia * r.cross(direction);
  return b.mass * direction + spin.cross(r);
}

TEST(Patch, MobilitiesAreTheResponseToImpulses) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 root = Mat3::Random();
    const Mobility body{0.3, root * root.transpose() + Mat3::Identity(), vector()};
    const Vec3 n = vector().normalized(), u = n.unitOrthogonal(), w = n.cross(u);
    std::vector<Vec3> points{vector(), vector(), vector()};
    Patch patch(plain(n), plain(body.centre));
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) {
      patch.add(plain(p));
      middle += p / 3;
    }
    EXPECT_NEAR(patch.at_middle(body).along, n.dot(response(body, middle, n)), 1e-10);
    EXPECT_NEAR(patch.at_middle(body).across, u.dot(response(body, middle, u)) + w.dot(response(body, middle, w)),
                1e-10);
  }
}

TEST(Patch, TheGreatestStiffnessBoundsEveryMotion) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 root = Mat3::Random();
    const Mobility body{0.3, root * root.transpose() + Mat3::Identity(), vector()};
    const Vec3 n = vector().normalized();
    Matrix6 k = Matrix6::Zero(), inverse = k;
    inverse.topLeftCorner<3, 3>() = body.mass * Mat3::Identity();
    inverse.bottomRightCorner<3, 3>() = body.inertia;
    const Vec3 first_origin = vector();
    Patch patch(plain(n), plain(first_origin));
    for (int p = 0; p < 4; ++p) {
      const Vec3 point = vector(), r = point - body.centre;
      patch.add(plain(point));
      Eigen::Matrix<double, 3, 6> jacobian;  // of the point's velocity
      jacobian << Mat3::Identity(), (Mat3() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0).finished();
      k += jacobian.transpose() * (0.7 * Mat3::Identity() + (1.9 - 0.7) * n * n.transpose()) * jacobian;
    }
    const law::SpringStiffness<double> all = patch.seen_from(plain(body.centre)).stiffness(1.9, 0.7);
    EXPECT_LT((matrix_of(all.translation) - k.topLeftCorner<3, 3>()).norm(), 1e-12 * k.norm());
    EXPECT_LT((matrix_of(all.rotation) - k.bottomRightCorner<3, 3>()).norm(), 1e-12 * k.norm());
    double greatest = 0;  // eigenvalue of inverse * k, by power iteration
    Vector6 direction = Vector6::Ones();
    for (int i = 0; i < 1000; ++i) {
      direction = inverse * Vector6(k * direction);
      greatest = direction.norm();
      direction /= greatest;
    }
    EXPECT_GE(all.max_eigenvalue_bound(body), greatest);
    EXPECT_LE(all.max_eigenvalue_bound(body), 4 * greatest);
  }
}

TEST(Patch, ABoxThatLandsFlatHasItsWholeMass) {
  const Mobility box{1 / 4.0, Vec3(30, 40, 50).asDiagonal(), {1, 2, 3}};
  Patch patch({0, 0, 1}, plain(box.centre));
  for (const double x : {-0.2, 0.2})
    for (const double y : {-0.1, 0.1}) patch.add({1 + x, 2 + y, 2.9});
  EXPECT_NEAR(1 / patch.at_middle(box).along, 4, 1e-12);
}

TEST(FrictionAnchor, FollowsItsPointWhateverTheOrderOfTheList) {
  std::vector<FrictionAnchor> before;
  for (int k = 0; k < 6; ++k) before.push_back({k < 2 ? 7u : k < 5 ? 8u : 9u, Vec3(k, 0, 0), Vec3(0, 0.1 * k, 0)});
  EXPECT_EQ(previous<FrictionAnchor>(before, 3, 8, {3.01, 0, 0})->displacement.y(), 0.1 * 3);
  EXPECT_EQ(previous<FrictionAnchor>(before, 0, 8, {4.2, 0.1, 0})->displacement.y(), 0.1 * 4);
  EXPECT_EQ(previous<FrictionAnchor>(before, 5, 8, {1.7, 0, 0})->displacement.y(), 0.1 * 2);
  EXPECT_EQ(previous<FrictionAnchor>(before, 40, 9, {0, 0, 0})->displacement.y(), 0.1 * 5);
  EXPECT_EQ(previous<FrictionAnchor>(before, 2, 10, {2, 0, 0}), nullptr);
  EXPECT_EQ(previous<FrictionAnchor>({}, 0, 7, {0, 0, 0}), nullptr);
  EXPECT_NE(pair_of(1, 2, 0, 0), pair_of(2, 1, 0, 0));
  EXPECT_NE(pair_of(1, 2, 1, 0), pair_of(1, 2, 0, 1));
}

}  // namespace
}  // namespace muro::penalty
