// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/simulation.hpp"
#include "muro/scene.hpp"

namespace muro::host {

/// What placement knows of mesh files: each is read once, by the reader for its type (reader.mesh).
class MeshCorners {
 public:
  explicit MeshCorners(Simulation& simulation) : simulation_(simulation) {}

  /// The corners (m) of the convex hull of the file's mesh. Empty where it cannot be read: what collides with it
  /// reports that.
  std::span<const Vec3> of(const std::string& path);
  /// The inertia of the body that the file describes, solid and with the density of water; none where it is flat or
  /// cannot be read.
  std::optional<Inertia> inertia_of(const std::string& path);
  /// Why the file cannot be read; empty where it can.
  const std::string& problem_of(const std::string& path) { return body_of(path).problem; }
  /// Whether a reader knows the type of the file and cannot read it. Algorithms may know other types.
  bool is_broken(const std::string& path) { return body_of(path).is_broken; }
  /// The box around a shape that stands at `pose`. `mesh`: the path of a mesh's file.
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
