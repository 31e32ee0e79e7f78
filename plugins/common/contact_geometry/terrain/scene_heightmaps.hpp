// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "muro/algorithm.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "terrain_contacts.hpp"

namespace muro::terrain_contact {

/// Heightmaps of a scene's scenery.
class SceneHeightmaps {
 public:
  /// Reads the files of all. A file that cannot be read is refused: see mesh::refuse_collision_mesh. [setup]
  void load(Connector& c);
  bool empty() const { return files_.empty(); }
  /// Returns the heightmap of a shape of kind heightmap; valid as long as this object lives.
  Heightmap of(const Shape& shape) const { return files_.at(shape.mesh)->heightmap(shape.size); }

 private:
  heightmap::Store store_;
  std::map<TextId, const heightmap::HeightmapFile*> files_;
};

}  // namespace muro::terrain_contact
