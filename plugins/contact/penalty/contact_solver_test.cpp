// SPDX-License-Identifier: MIT
#include "contact_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace muro::penalty {
namespace {

/// A random system of bodies with couplings, sparse and dense, similar to one of bodies on dampers.
struct RandomSystem {
  BlockSystem sparse;
  Eigen::MatrixXd dense;
  std::vector<BlockSystem::Vector> right, found;

  RandomSystem(std::mt19937& random, std::uint32_t bodies, const std::vector<std::pair<int, int>>& pairs) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto size = Eigen::Index(6 * bodies);
    dense = Eigen::MatrixXd::Identity(size, size);
    sparse.start(bodies);
    std::vector<std::uint32_t> couplings;
    for (const auto& [a, b] : pairs) couplings.push_back(sparse.couple(std::uint32_t(a), std::uint32_t(b)));
    sparse.find_order();
    for (std::uint32_t i = 0; i < bodies; ++i) sparse.diagonal(i).setIdentity();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [a, b] = pairs[k];
      const auto jacobian = [&] {
        return Eigen::Matrix<double, 3, 6>(Eigen::Matrix<double, 3, 6>::NullaryExpr([&] { return 30 * any(random); }));
      };
      const Eigen::Matrix<double, 3, 6> of_a = jacobian(), of_b = jacobian();
      sparse.diagonal(std::uint32_t(a)) += of_a.transpose() * of_a;
      sparse.diagonal(std::uint32_t(b)) += of_b.transpose() * of_b;
      sparse.add(couplings[k], std::uint32_t(a), -of_a.transpose() * of_b);
      dense.block<6, 6>(6 * a, 6 * a) += of_a.transpose() * of_a;
      dense.block<6, 6>(6 * b, 6 * b) += of_b.transpose() * of_b;
      dense.block<6, 6>(6 * a, 6 * b) -= of_a.transpose() * of_b;
      dense.block<6, 6>(6 * b, 6 * a) -= of_b.transpose() * of_a;
    }
    right.resize(bodies);
    for (auto& r : right) r = BlockSystem::Vector::NullaryExpr([&] { return any(random); });
    found.assign(bodies, BlockSystem::Vector::Zero());
  }
  double error() const {
    Eigen::VectorXd r(dense.rows()), x(dense.rows());
    for (std::size_t i = 0; i < right.size(); ++i) {
      r.segment<6>(Eigen::Index(6 * i)) = right[i];
      x.segment<6>(Eigen::Index(6 * i)) = found[i];
    }
    return (x - dense.ldlt().solve(r)).norm() / x.norm();
  }
};

TEST(BlockSystem, SolvesATreeInOneIteration) {
  std::mt19937 random(1);
  for (int bodies = 1; bodies < 30; ++bodies) {
    std::vector<std::pair<int, int>> pairs;
    for (int i = 1; i < bodies; ++i) pairs.emplace_back(int(random() % unsigned(i)), i);
    std::shuffle(pairs.begin(), pairs.end(), random);
    RandomSystem s(random, std::uint32_t(bodies), pairs);
    EXPECT_LE(s.sparse.solve(s.right, s.found, 1e-18), 2);
    EXPECT_LT(s.error(), 1e-8) << bodies;
  }
}

TEST(BlockSystem, SolvesAnyGraph) {
  std::mt19937 random(2);
  for (int round = 0; round < 40; ++round) {
    const int bodies = 3 + round % 20;
    std::vector<std::pair<int, int>> pairs;
    for (int k = 0; k < 3 * bodies; ++k) {
      const int a = int(random() % unsigned(bodies)), b = int(random() % unsigned(bodies));
      if (a != b) pairs.emplace_back(a, b);
    }
    RandomSystem s(random, std::uint32_t(bodies), pairs);
    s.sparse.solve(s.right, s.found, 1e-20);
    EXPECT_LT(s.error(), 1e-6) << bodies;
  }
}

constexpr double solver_step = 1e-3, solver_omega = 2 * M_PI * 50;

law::Mobility<double> free_ball(double mass, double height) {
  const double i = 1 / (0.4 * mass * 0.01);
  return {1 / mass, {i, i, i, 0, 0, 0}, {0, 0, height}};
}

SolverContact held_contact(double mass, double depth, double friction) {
  SolverContact c;
  const double stiffness = mass * solver_omega * solver_omega;
  c.normal = Vec3::UnitZ();
  c.along = c.across = 2 * mass * solver_omega + solver_step * stiffness;
  c.push = stiffness * depth;
  c.friction = friction;
  return c;
}

TEST(ContactSolver, AHeavyBodyOnALightOneIsCarried) {
  // Both contacts have the depth that carries the load above: nothing moves, and forces are the weights.
  ContactSolver solver;
  solver.start(solver_step);
  const double below = 0.01, above = 10, all = below + above, g = 9.81;
  const double of_mass = g / (all * solver_omega * solver_omega);
  const std::uint32_t low =
      solver.add_body(free_ball(below, 0.1), Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -g * solver_step), Vec3::Zero());
  const std::uint32_t high =
      solver.add_body(free_ball(above, 0.3), Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -g * solver_step), Vec3::Zero());
  SolverContact ground = held_contact(all, all * of_mass, 0.5), pair = held_contact(all, above * of_mass, 0.5);
  ground.body = low, ground.lever = Vec3(0, 0, -0.1);
  pair.body = high, pair.lever = Vec3(0, 0, -0.1), pair.other = low, pair.other_lever = Vec3(0, 0, 0.1);
  solver.add_contact() = ground;
  solver.add_contact() = pair;
  const auto found = solver.solve();
  EXPECT_NEAR(found[0].force.z(), all * g, 1e-9 * all * g);
  EXPECT_NEAR(found[1].force.z(), above * g, 1e-9 * all * g);
}

TEST(ContactSolver, FrictionStaysInItsConeAndIsAgainstTheSlip) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 200; ++round) {
    ContactSolver solver;
    solver.start(solver_step);
    const std::uint32_t ball =
        solver.add_body(free_ball(1, 0.1), Vec3(any(random), any(random), 0.2 * any(random)),
                        10 * Vec3(any(random), any(random), any(random)), Vec3::Zero(), Vec3::Zero());
    SolverContact& c = solver.add_contact() = held_contact(1, 1e-4, 0.3);
    c.body = ball, c.lever = Vec3(0, 0, -0.1);
    const SolverContact& found = solver.solve().front();
    const Vec3 across(found.force.x(), found.force.y(), 0);
    EXPECT_LE(across.norm(), 0.3 * found.force.z() * (1 + 1e-12));
    EXPECT_GE(found.force.z(), 0);
  }
}

}  // namespace
}  // namespace muro::penalty
