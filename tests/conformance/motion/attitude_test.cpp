// SPDX-License-Identifier: MIT
// Motions with `attitude: exact`: tops without torque. Their spin is compared with Jacobi's elliptic functions (Landau
// and Lifshitz, Mechanics, section 37), their attitude with an integration in steps of 20 us.
#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {
namespace {

/// Moments of inertia, kg m^2, about x, y, z of the body.
const Vec3 moments(0.3, 0.5, 0.7);

struct State {
  Eigen::Vector4d q;  ///< x, y, z, w
  Vec3 spin;          ///< axes of the body

  State operator+(const State& b) const { return {q + b.q, spin + b.spin}; }
  State operator*(double s) const { return {q * s, spin * s}; }
};

State rate_of(const State& s) {
  const Quat q(s.q);
  const Quat turn = q * Quat(0, s.spin.x(), s.spin.y(), s.spin.z());
  const Vec3 momentum = moments.cwiseProduct(s.spin);
  return {0.5 * turn.coeffs(), momentum.cross(s.spin).cwiseQuotient(moments)};
}

/// Integrates by the fourth-order method of Runge and Kutta.
State integrated(State s, double duration) {
  const int steps = int(duration / 2e-5);
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const State a = rate_of(s), b = rate_of(s + a * (h / 2)), c = rate_of(s + b * (h / 2)), d = rate_of(s + c * h);
    s = s + (a + b * 2 + c * 2 + d) * (h / 6);
    s.q.normalize();
  }
  return s;
}

std::vector<std::string> motions_with_attitude() {
  std::vector<std::string> found;
  for (const std::string& motion : motions())
    for (const Parameter& p : description_of(motion).parameters)
      if (p.name == "attitude") found.push_back(motion);
  return found;
}

struct ExactAttitude : ::testing::TestWithParam<std::string> {
  /// Adds a top at rest except for its spin (axes of the body). Its frame is not at its centre of mass.
  static const RobotView& add_top(Trial& t, const Vec3& spin, const Quat& start, const Vec3& com = Vec3::Zero()) {
    t.set_gravity(Vec3::Zero());
    const Inertia inertia = Inertia::from(12, com, moments.asDiagonal());
    const Vec3 of_world = start * spin;
    return t.add("top", test::single_body(Shape::box({0.3, 0.2, 0.1}), inertia), {{0, 0, 5}, start},
                 {-of_world.cross(start * com), of_world});
  }
};

TEST_P(ExactAttitude, IsThatOfTheTopTo1e6OfARadianAfter10S) {
  // about each axis, also the unstable middle one, and about no axis of the body
  for (const Vec3& spin : {Vec3(5, 0.1, 0.2), Vec3(0.01, 5, 0.02), Vec3(0.1, 0.2, 5), Vec3(3, -4, 5)}) {
    Trial t(GetParam());
    const Quat start = from_rpy(0.3, -0.5, 2);
    const RobotView& r = add_top(t, spin, start, {0.02, -0.03, 0.05});
    t.start({{"attitude", std::string("exact")}});
    t.run_for(10);
    const State expected = integrated({start.coeffs(), spin}, 10);
    EXPECT_LT(t.pose(r).orientation.angularDistance(Quat(expected.q)), 1e-6) << spin.transpose();
    EXPECT_LT((t.pose(r).orientation.conjugate() * t.twist(r).angular - expected.spin).norm(), 1e-6);
  }
}

TEST_P(ExactAttitude, ItsSpinIsThatOfTheEllipticFunctions) {
  const Vec3 spin(2, 0, 4);
  Trial t(GetParam());
  const RobotView& r = add_top(t, spin, Quat::Identity());
  t.start({{"attitude", std::string("exact")}});
  t.run_for(10);
  const Vec3 i = moments, l = moments.cwiseProduct(spin);
  const double energy2 = l.dot(spin), square = l.squaredNorm();
  ASSERT_GT(square, energy2 * i.y());
  const double rate = std::sqrt((i.z() - i.y()) * (square - energy2 * i.x()) / (i.x() * i.y() * i.z()));
  const double modulus =
      std::sqrt((i.y() - i.x()) * (energy2 * i.z() - square) / ((i.z() - i.y()) * (square - energy2 * i.x())));
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus, rate * 10, &cn, &dn);
  const Vec3 expected(spin.x() * cn, std::sqrt((energy2 * i.z() - square) / (i.y() * (i.z() - i.y()))) * sn,
                      spin.z() * dn);
  EXPECT_LT((t.pose(r).orientation.conjugate() * t.twist(r).angular - expected).norm(), 1e-9);
}

TEST_P(ExactAttitude, TorquesAndContactsTurnTheBodyAsBefore) {
  for (const char* attitude : {"engine", "exact"}) {
    Trial t(GetParam());
    t.add_ground(0.8);
    const RobotView& pushed = t.add("pushed", block(2, {0.2, 0.2, 0.2}, 0.5), {{0, 0, 50}, Quat::Identity()});
    const RobotView& rests = t.add("rests", block(3, {0.4, 0.3, 0.2}, 0.8), {{9, 0, 0.12}, Quat::Identity()});
    const RobotView& tips = t.add("tips", block(1, {0.1, 0.1, 1}, 0.8), {{5, 0, 0.6}, from_rpy(0.3, 0, 0)});
    Wrench& w = t.push(pushed);
    t.start({{"attitude", std::string(attitude)}});
    w = {Vec3::Zero(), {0, 0, 0.1}};
    t.run_for(1);
    EXPECT_NEAR(t.twist(pushed).angular.z(), 0.1 / solid_box(2, {0.2, 0.2, 0.2}).izz, 1e-9) << attitude;
    t.run_for(2);
    EXPECT_NEAR(t.pose(rests).position.z(), 0.1, 1e-3) << attitude;
    EXPECT_LT(t.pose(rests).orientation.angularDistance(Quat::Identity()), 1e-3) << attitude;
    EXPECT_NEAR(t.pose(tips).position.z(), 0.05, 2e-3) << attitude << ": it has fallen on its side";
  }
}

TEST_P(ExactAttitude, ASnapshotInTheMiddleChangesNothing) {
  Trial t(GetParam());
  add_top(t, {3, -4, 5}, Quat::Identity(), {0.02, -0.03, 0.05});
  t.start({{"attitude", std::string("exact")}});
  t.run_for(0.3);
  const Snapshot middle = t.snapshot();
  t.run_for(0.5);
  const std::uint64_t end = t.state_hash();
  t.restore(middle);
  t.run_for(0.5);
  EXPECT_EQ(t.state_hash(), end);
}

INSTANTIATE_TEST_SUITE_P(Motions, ExactAttitude, ::testing::ValuesIn(motions_with_attitude()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExactAttitude);

}  // namespace
}  // namespace muro::conformance
