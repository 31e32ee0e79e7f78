// SPDX-License-Identifier: MIT
#include "host/scenario/mesh_corners.hpp"

#include <cstring>

#include "core/error.hpp"
#include "core/point_bounds.hpp"
#include "muro/base/bounds.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"

namespace muro::host {

std::span<const Vec3> MeshCorners::of(const std::string& path) { return body_of(path).corners; }

std::optional<Inertia> MeshCorners::inertia_of(const std::string& path) { return body_of(path).inertia; }

Aabb MeshCorners::bounds_of(const Shape& shape, const std::string& mesh, const Pose& pose) {
  if (shape.kind != ShapeKind::mesh) return muro::bounds_of(shape, pose);
  return bounds_of_points(of(mesh), shape.size, pose);
}

const MeshCorners::Body& MeshCorners::body_of(const std::string& path) {
  const auto [known, is_new] = known_.try_emplace(path);
  Body& body = known->second;
  if (!is_new) return body;
  try {
    static_cast<void>(simulation_.registry().reader_for(path));
    body.is_broken = true;  // until it is read
    const RobotTree tree = simulation_.read_model(path);
    for (const RobotTree::Constant& c : tree.components().front().constants) {
      if (c.key.name == keys::mesh_corners.name) {
        body.corners.resize(c.count);
        std::memcpy(static_cast<void*>(body.corners.data()), c.data.data(), c.data.size());
      } else if (c.key.name == keys::inertial.name && c.data.size() == sizeof(Inertia)) {
        body.inertia.emplace();
        std::memcpy(static_cast<void*>(&*body.inertia), c.data.data(), sizeof(Inertia));
      }
    }
    body.is_broken = false;
  } catch (const SetupError& e) {
    body.problem = e.what();
    const std::string beginning = "model " + path + ": ";  // the file is not a model
    if (body.problem.starts_with(beginning)) body.problem.erase(0, beginning.size());
  }
  return body;
}

}  // namespace muro::host
