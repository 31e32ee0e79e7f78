// SPDX-License-Identifier: MIT
#include "omni_jacobian.hpp"

#include <Eigen/Eigenvalues>

#include "muro/base/elementary.hpp"

namespace muro::wheels {

std::vector<PlanarTwist> jacobian_columns(const RobotView& robot, std::span<const OmniWheel> wheels) {
  double length = 0;  // converts the turn rate to a velocity, so that all three have the same unit
  for (const OmniWheel& w : wheels) length = std::max(length, w.centre.head<2>().norm());
  const Vec3 scale(1, 1, length > 0 ? 1 / length : 1);
  std::vector<Vec3> rows;
  Mat3 normal = Mat3::Zero();
  for (const OmniWheel& w : wheels) {
    const PlanarTwist e = inverse_jacobian_row(w) * (w.radius * elementary::cos(w.roller_angle));
    rows.push_back(Vec3(e.x, e.y, e.yaw_rate).cwiseProduct(scale));
    normal += rows.back() * rows.back().transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(normal);  // eigenvalues are squares of the rows' singular values
  if (eigen.eigenvalues()[0] < 1e-12 * eigen.eigenvalues()[2])
    throw Error(
        "the wheels of `" + std::string(robot.name) +
        "` do not hold it: with all of them at rest it can still move. Look at their places, and at "
        "`roller_angle`: the axes of the rollers on the ground must neither be all parallel nor meet in a point");
  const Mat3 inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  std::vector<PlanarTwist> columns;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const Vec3 v = scale.cwiseProduct(inverse * rows[i]) * (wheels[i].radius * elementary::cos(wheels[i].roller_angle));
    columns.push_back({v.x(), v.y(), v.z()});
  }
  return columns;
}

}  // namespace muro::wheels
