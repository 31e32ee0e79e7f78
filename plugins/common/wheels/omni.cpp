// SPDX-License-Identifier: MIT
#include "omni.hpp"

#include <Eigen/Eigenvalues>

namespace muro::wheeled {

std::vector<PlanarTwist> shares_of(const RobotView& robot, std::span<const OmniWheel> wheels) {
  double length = 0;  // makes the turn a velocity, so that the three are of one kind
  for (const OmniWheel& w : wheels) length = std::max(length, w.centre.head<2>().norm());
  const Vec3 scale(1, 1, length > 0 ? 1 / length : 1);
  std::vector<Vec3> rows;
  Mat3 normal = Mat3::Zero();
  for (const OmniWheel& w : wheels) {
    const PlanarTwist e = asks_of(w) * (w.radius * std::cos(w.roller_angle));
    rows.push_back(Vec3(e.x, e.y, e.turn).cwiseProduct(scale));
    normal += rows.back() * rows.back().transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(normal);  // eigenvalues are squares of the rows' singular values
  if (modes.eigenvalues()[0] < 1e-12 * modes.eigenvalues()[2])
    throw Error(
        "the wheels of `" + std::string(robot.name) +
        "` do not hold it: with all of them at rest it can still move. Look at their places, and at "
        "`roller_angle`: the axes of the rollers on the ground must neither be all parallel nor meet in a point");
  const Mat3 inverse =
      modes.eigenvectors() * modes.eigenvalues().cwiseInverse().asDiagonal() * modes.eigenvectors().transpose();
  std::vector<PlanarTwist> shares;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const Vec3 v = scale.cwiseProduct(inverse * rows[i]) * (wheels[i].radius * std::cos(wheels[i].roller_angle));
    shares.push_back({v.x(), v.y(), v.z()});
  }
  return shares;
}

}  // namespace muro::wheeled
