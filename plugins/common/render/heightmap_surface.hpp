// SPDX-License-Identifier: MIT
#pragma once

#include "muro/toolkit/heightmap.hpp"
#include "surface.hpp"

namespace muro::render {

/// A part of what is drawn of a heightmap, about `centre` (m, in the frame of the shape).
struct HeightmapPart {
  Surface surface;
  Vec3 centre = Vec3::Zero();
};

/// The ground in squares of 128 x 128 cells, so that what is out of sight is not drawn, with normals that are smooth
/// over it and texture coordinates that go over the whole map once, the upper side of a picture at +y; then the walls
/// below its rim and its floor, down to the lowest height.
std::vector<HeightmapPart> parts_of(const Heightmap& heightmap);

}  // namespace muro::render
