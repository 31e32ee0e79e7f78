// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/simulation.hpp"
#include "muro/scene.hpp"

namespace muro::host {

/// Mesh files, for placement: each is read once, by the reader for its type (reader.mesh).
class MeshCorners {
 public:
  explicit MeshCorners(Simulation& simulation) : simulation_(simulation) {}

  /// Returns the corners (m) of the convex hull of the file's mesh. Empty when it cannot be read: the algorithm that
  /// uses it for collisions reports that.
  std::span<const Vec3> of(const std::string& path);
  /// Returns the inertia of the body in the file, solid and with the density of water; nothing when it is flat or
  /// cannot be read.
  std::optional<Inertia> inertia_of(const std::string& path);
  /// Returns why the file cannot be read; empty when it can.
  const std::string& problem_of(const std::string& path) { return body_of(path).problem; }
  /// Whether a reader knows the type of the file and cannot read it. Algorithms may know other types.
  bool is_broken(const std::string& path) { return body_of(path).is_broken; }
  /// Returns the box around a shape at `pose`. `mesh`: path of the file, for a mesh.
  Aabb bounds_of(const Shape& shape, const std::string& mesh, const Pose& pose);

 private:
  struct Body {
    std::vector<Vec3> corners;
    std::optional<Inertia> inertia;
    std::string problem;
    bool is_broken = false;
  };
  const Body& body_of(const std::string& path);

  Simulation& simulation_;
  std::map<std::string, Body> known_;
};

}  // namespace muro::host
