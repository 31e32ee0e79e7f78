// SPDX-License-Identifier: MIT
#pragma once

#include "muro/toolkit/heightmap.hpp"
#include "surface.hpp"

namespace muro::render {

/// A drawn part of a heightmap, about `centre` (m, in the frame of the shape).
struct HeightmapPart {
  Surface surface;
  Vec3 centre = Vec3::Zero();
};

/// Returns the ground in squares of 128 x 128 cells, so that parts out of sight are not drawn. Normals are smooth over
/// the ground. Texture coordinates cover the whole map once, with the upper side of a picture at +y. Then come the
/// walls below its rim and its floor, down to the lowest height.
std::vector<HeightmapPart> parts_of(const Heightmap& heightmap);

}  // namespace muro::render
