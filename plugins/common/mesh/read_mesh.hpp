// SPDX-License-Identifier: MIT
// Reading of meshes in the parser process for load.cpp, with Assimp.
#pragma once

#include "submesh.hpp"

namespace muro::mesh {

/// Reads a file as load() and load_submeshes() do, but in this process. `path` is absolute.
Mesh read_mesh(const std::string& path, const Vec3& scale);
std::vector<Submesh> read_submeshes(const std::string& path, const Vec3& scale);

}  // namespace muro::mesh
