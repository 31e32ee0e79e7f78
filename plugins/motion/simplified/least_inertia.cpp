// SPDX-License-Identifier: MIT
#include "least_inertia.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "muro/toolkit/bounds.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/vocabulary.hpp"

namespace muro::simplified {

std::optional<Mat3> missing_inertia(const Inertia& inertia, const Aabb& box) {
  constexpr double least = 0.01;
  const Vec3 size = box.high - box.low, squares = size.cwiseProduct(size);
  const Vec3 floor =
      least * inertia.mass / 12 * Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  // in units in which the least inertia is 1 about every axis
  const Vec3 root = floor.cwiseSqrt();
  const Mat3 scaled = root.cwiseInverse().asDiagonal() * inertia.tensor() * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(scaled);
  if (!principal.eigenvalues().allFinite() || principal.eigenvalues().minCoeff() >= 1) return {};
  const Vec3 missing = (Vec3::Ones() - principal.eigenvalues()).cwiseMax(0);
  const Mat3& axes = principal.eigenvectors();
  return Mat3(root.asDiagonal() * (axes * missing.asDiagonal() * axes.transpose()) * root.asDiagonal());
}

bool complete_inertia(Connector& c, const RobotView& robot, std::span<const double> positions,
                      std::vector<Inertia>& inertias) {
  Aabb box;
  std::vector<Pose> poses(robot.links.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) poses[i] = poses[std::size_t(robot.links[i].parent)] * pose_in_parent(robot.links[i], positions[i]);
    for (const Shape& s : c.constant_array(robot.links[i].object, keys::collision_shapes))
      if (s.kind != ShapeKind::plane && s.kind != ShapeKind::mesh) box.include(bounds_of(s, poses[i] * s.origin));
  }
  const Inertia total = composite_inertia(robot.links, inertias, positions);
  if (!(total.mass > 0) || !((box.high - box.low).minCoeff() > 0)) return false;
  const std::optional<Mat3> missing = missing_inertia(total, box);
  if (!missing) return false;
  const auto heaviest = std::max_element(inertias.begin(), inertias.end(),
                                         [](const Inertia& a, const Inertia& b) { return a.mass < b.mass; });
  const auto link = std::size_t(heaviest - inertias.begin());
  const Mat3 r = poses[link].orientation.toRotationMatrix();
  *heaviest = Inertia::from(heaviest->mass, heaviest->com, heaviest->tensor() + r.transpose() * *missing * r);
  c.set(robot.links[link].object, keys::inertial, *heaviest);
  return true;
}

}  // namespace muro::simplified
