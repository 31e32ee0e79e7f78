// SPDX-License-Identifier: MIT
#pragma once

#include "host/scenario/heightmap_files.hpp"
#include "host/scenario/mesh_corners.hpp"

namespace muro::host {

/// What placement and the check of overlaps know of the files of shapes.
struct ShapeFiles {
  explicit ShapeFiles(Simulation& simulation) : meshes(simulation), heightmaps(simulation) {}
  MeshCorners meshes;
  HeightmapFiles heightmaps;
};

}  // namespace muro::host
