// SPDX-License-Identifier: MIT
// Heightmaps in the form in which rays search them.
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/scene.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "scene_view.hpp"

namespace muro::raycast {

/// A heightmap with planes over its parts, see HeightField::planes.
class HeightTree {
 public:
  HeightTree(heightmap::HeightmapFile file, const Vec3& size);

  Heightmap heightmap() const { return file_.heightmap(size_); }
  const Aabb& bounds() const { return bounds_; }  ///< in the frame of the shape
  HeightField field() const;                      ///< valid during the life of the tree

 private:
  heightmap::HeightmapFile file_;
  Vec3 size_;
  Aabb bounds_;
  std::vector<HeightPlane> planes_;
  std::uint32_t plane_columns_ = 0, upper_column_ = 0, upper_rows_ = 0, widest_ = 0;
  double slope_step_ = 0;
};

/// The trees of all heightmaps of a world.
class HeightTrees {
 public:
  /// Reads the files of all heightmaps among the collision shapes. A heightmap that cannot be read is refused, see
  /// mesh::refuse_collision_mesh. [setup]
  void connect(Connector& c);
  void add(const Shape& shape, heightmap::HeightmapFile file);
  /// Returns null for a heightmap that was refused.
  const HeightTree* find(const Shape& shape) const;

 private:
  using Key = std::tuple<std::uint32_t, double, double, double>;
  static Key key_of(const Shape& s) { return {static_cast<std::uint32_t>(s.mesh), s.size.x(), s.size.y(), s.size.z()}; }
  std::map<Key, std::unique_ptr<HeightTree>> trees_;
};

}  // namespace muro::raycast
