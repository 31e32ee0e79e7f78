// SPDX-License-Identifier: MIT
#include "least_inertia.hpp"

#include <algorithm>
#include <string>

#include "muro/base/bounds.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/motion/common/multibody/missing_inertia.hpp"

namespace muro::simplified {

namespace {

/// Returns the box around a shape at `pose`. The box is empty for a shape without size, and for a mesh that cannot be
/// read: the algorithm that collides with it reports that.
Aabb box_around(const Connector& c, const Shape& shape, const Pose& pose, mesh::Store& meshes) {
  Aabb box;
  if (shape.kind == ShapeKind::plane) return box;
  if (shape.kind != ShapeKind::mesh) return bounds_of(shape, pose);
  try {
    for (const Vec3& v : meshes.mesh(std::string(c.text(shape.mesh)), shape.size).vertices)
      box.include({pose * v, pose * v});
  } catch (const Error&) {
  }
  return box;
}

}  // namespace

bool complete_inertia(Connector& c, const RobotView& robot, std::span<const double> positions,
                      std::vector<Inertia>& inertias, mesh::Store& meshes) {
  Aabb box;
  std::vector<Pose> poses(robot.links.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) poses[i] = poses[std::size_t(robot.links[i].parent)] * pose_in_parent(robot.links[i], positions[i]);
    for (const Shape& s : c.constant_array(robot.links[i].object, keys::collision_shapes))
      box.include(box_around(c, s, poses[i] * s.origin, meshes));
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
