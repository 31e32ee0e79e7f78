// SPDX-License-Identifier: MIT
// What the parser process does for load.cpp, with Assimp.
#pragma once

#include "submesh.hpp"

namespace muro::mesh {

/// As load() and load_submeshes(), in this process. `path` is absolute.
Mesh read_mesh(const std::string& path, const Vec3& scale);
std::vector<Submesh> read_submeshes(const std::string& path, const Vec3& scale);

}  // namespace muro::mesh
