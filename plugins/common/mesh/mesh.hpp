// SPDX-License-Identifier: MIT
// Triangle meshes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "muro/scene.hpp"

namespace muro::mesh {

/// Numbers of a triangle's vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
  std::vector<Vec3> vertices;  ///< m; all different
  std::vector<Triangle> triangles;
};

/// Reads a file (absolute path; .dae, .stl, .obj, .gltf or .glb in lower or upper case, and all else that Assimp
/// reads). Joins all meshes of all its nodes, in the axes of the file's root, z up. The unit is that of the file
/// (COLLADA) or metres (all others), times `scale` (factors along x, y, z; negative ones mirror). A closed mesh faces
/// outward whatever the file says. Throws muro::Error with the path if the file is missing, cannot be read or has no
/// triangle with an area. [setup]
Mesh load(const std::string& path, const Vec3& scale);

/// Returns the bounds (m) of all vertices.
Aabb bounds_of(const Mesh& mesh);
/// Whether every edge belongs to two triangles, which pass it in opposite directions.
bool is_closed(const Mesh& mesh);
/// Whether it is closed, and no vertex is farther outside any triangle's plane than `tolerance` times the bounds'
/// diagonal.
bool is_convex(const Mesh& mesh, double tolerance = 1e-6);
/// Returns the volume (m^3) of a closed mesh; negative if it faces inward.
double volume_of(const Mesh& mesh);

/// Joins equal vertices, and removes triangles without an area and vertices without a triangle.
void clean(Mesh& mesh);

}  // namespace muro::mesh
