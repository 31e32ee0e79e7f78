// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "hull.hpp"

namespace muro::mesh {

/// A cache of meshes by file and scale: each is read once, or fails once, and its hull is computed at the first
/// request. References stay valid as long as the store lives. [setup]
class Store {
 public:
  /// Returns a mesh as load() does.
  const Mesh& mesh(const std::string& path, const Vec3& scale);
  /// Returns the convex hull of a mesh. Throws muro::Error if the mesh is flat.
  const Hull& hull(const std::string& path, const Vec3& scale);
  /// Returns the convex hull of a mesh; if it is flat, a thin plate. Throws muro::Error if it lies on a line.
  const Hull& hull_or_plate(const std::string& path, const Vec3& scale);

 private:
  struct Entry {
    std::string error;  ///< error of a file that cannot be read, since reading may have taken long
    Mesh mesh;
    std::optional<Hull> hull, plate;
  };
  Entry& entry(const std::string& path, const Vec3& scale);

  std::map<std::tuple<std::string, double, double, double>, std::unique_ptr<Entry>> entries_;
};

}  // namespace muro::mesh
