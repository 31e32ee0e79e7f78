// SPDX-License-Identifier: MIT
#include "apparent_mass.hpp"
#include "muro/toolkit/link_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace muro::penalty {

namespace {

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

MassProperties properties(double inverse_mass, const Vec3& com, const Mat3& inverse) {
  MassProperties mass{
      .inverse_mass = inverse_mass,
      .inverse_inertia = {inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(0, 1), inverse(0, 2), inverse(1, 2)}};
  std::copy_n(com.data(), 3, mass.com);
  return mass;
}

/// The bodies of a robot at rest, in the frame of its base.
class Tree {
 public:
  Tree(Rows<Link> links, std::span<const double> positions) : links_(links), in_base_(links.size()) {
    for (std::size_t i = 1; i < links.size(); ++i)
      in_base_[i] = in_base_[std::size_t(links[i].parent)] * pose_in_parent(links[i], positions[i]);
  }
  const Pose& operator[](std::size_t i) const { return in_base_[i]; }
  Eigen::Index columns() const { return Eigen::Index(6 + links_.size()); }

  /// Returns the velocity (linear, angular) of the point `at` of body `i`, per velocities of the base and of all
  /// joints.
  Jacobian jacobian(std::size_t i, const Vec3& at) const {
    Jacobian j = Jacobian::Zero(6, columns());
    const auto add_rotation = [&](Eigen::Index column, const Vec3& axis, const Vec3& centre) {
      j.col(column).head<3>() = axis.cross(at - centre);
      j.col(column).tail<3>() = axis;
    };
    for (int k = 0; k < 3; ++k) {
      j(k, k) = 1;
      add_rotation(3 + k, Vec3::Unit(k), Vec3::Zero());
    }
    for (std::size_t f = i; f > 0; f = std::size_t(links_[f].parent)) {
      const Vec3 axis = in_base_[f].orientation * links_[f].axis;
      const Eigen::Index column = 6 + Eigen::Index(f);
      if (links_[f].joint == JointKind::revolute) add_rotation(column, axis, in_base_[f].position);
      if (links_[f].joint == JointKind::prismatic) j.col(column).head<3>() = axis;
    }
    return j;
  }

 private:
  Rows<Link> links_;
  std::vector<Pose> in_base_;
};

}  // namespace

MassProperties mass_properties_of(const Inertia& body) {
  return properties(1 / body.mass, body.com, body.tensor().inverse());
}

ApparentMasses apparent_masses(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> positions,
                               std::span<const std::uint32_t> bodies) {
  const Tree tree(links, positions);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(tree.columns(), tree.columns());
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!(inertias[i].mass > 0)) continue;
    const Jacobian j = tree.jacobian(i, tree[i] * inertias[i].com);
    const Mat3 r = tree[i].orientation.toRotationMatrix(), tensor = r * inertias[i].tensor() * r.transpose();
    mass += inertias[i].mass * j.topRows<3>().transpose() * j.topRows<3>() +
            j.bottomRows<3>().transpose() * tensor * j.bottomRows<3>();
  }
  // Small inertias for joints that move nothing, and for columns of fixed joints.
  const double least = 1e-9 * mass.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < mass.rows(); ++k)
    if (mass(k, k) < least) mass(k, k) = least;
  const Eigen::LDLT<Eigen::MatrixXd> solver(mass);

  ApparentMasses apparent;
  const auto rows = 6 * Eigen::Index(bodies.size());
  Eigen::MatrixXd all(rows, tree.columns()), roots = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::uint32_t i = bodies[k];
    const Vec3& com = inertias[i].com;
    const Jacobian j = tree.jacobian(i, tree[i] * com);
    const Eigen::Matrix<double, 6, 6> mobility = j * solver.solve(j.transpose());
    const Mat3 translation = mobility.topLeftCorner<3, 3>(), rotation = mobility.bottomRightCorner<3, 3>();
    const Mat3 r = tree[i].orientation.toRotationMatrix();
    const Mat3 turning = 0.5 * (rotation + rotation.transpose()), own = r.transpose() * turning * r;
    const double inverse_mass = Eigen::SelfAdjointEigenSolver<Mat3>(translation).eigenvalues().maxCoeff();
    apparent.bodies.push_back(properties(inverse_mass, com, own));
    const auto row = 6 * Eigen::Index(k);
    all.middleRows<6>(row) = j;
    roots.block<3, 3>(row, row) = Mat3::Identity() / std::sqrt(inverse_mass);
    roots.block<3, 3>(row + 3, row + 3) = Eigen::SelfAdjointEigenSolver<Mat3>(turning).operatorInverseSqrt();
  }
  apparent.coupling = roots * all * solver.solve(all.transpose()) * roots;
  return apparent;
}

double ApparentMasses::shared_by(std::span<const std::uint32_t> touched) const {
  constexpr int iterations = 12;
  constexpr double margin = 1.1;  // for what the iteration does not reach
  if (touched.size() < 2) return 1;
  const auto block = [&](std::size_t i, std::size_t k) {
    return coupling.block<6, 6>(6 * Eigen::Index(touched[i]), 6 * Eigen::Index(touched[k]));
  };
  std::array<Eigen::Matrix<double, 6, 1>, most_touched> x, y;
  const std::size_t count = std::min(touched.size(), most_touched);
  for (std::size_t i = 0; i < count; ++i) x[i] << 1, 1.1, 1.2, 1.3 + double(i), 1.4, -1;
  double size = 1;
  for (int n = 0; n < iterations; ++n) {
    double square = 0;
    for (std::size_t i = 0; i < count; ++i) {
      y[i].setZero();
      for (std::size_t k = 0; k < count; ++k) y[i].noalias() += block(i, k) * x[k];
      square += y[i].squaredNorm();
    }
    size = std::sqrt(square);
    if (!(size > 0)) return 1;
    for (std::size_t i = 0; i < count; ++i) x[i] = y[i] / size;
  }
  return std::max(1.0, margin * size);
}

}  // namespace muro::penalty
