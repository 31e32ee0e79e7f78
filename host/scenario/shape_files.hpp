// SPDX-License-Identifier: MIT
#pragma once

#include "host/scenario/heightmap_files.hpp"
#include "host/scenario/mesh_corners.hpp"

namespace muro::host {

/// Files of shapes, for placement and for the check of overlaps.
struct ShapeFiles {
  explicit ShapeFiles(Simulation& simulation) : meshes(simulation), heightmaps(simulation) {}
  MeshCorners meshes;
  HeightmapFiles heightmaps;
};

}  // namespace muro::host
