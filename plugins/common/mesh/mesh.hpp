// SPDX-License-Identifier: MIT
// Triangle meshes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "muro/scene.hpp"

namespace muro::mesh {

/// Numbers of its vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
  std::vector<Vec3> vertices;  ///< m; all different
  std::vector<Triangle> triangles;
};

/// Reads a file (absolute path; .dae, .stl, .obj, .gltf or .glb in any case, and whatever else Assimp reads): all
/// meshes of all its nodes as one, in the axes of the file's root, z up, with the unit the file states (COLLADA) or
/// metres (all others), times `scale` (factors along x, y, z; negative ones mirror). A closed mesh looks outward
/// whatever the file says. Throws muro::Error with the path when the file is missing, cannot be read or has no triangle
/// with an area. [setup]
Mesh load(const std::string& path, const Vec3& scale);

/// Around all vertices, m.
Aabb bounds_of(const Mesh& mesh);
/// Every edge belongs to two triangles, which pass it in opposite directions.
bool is_closed(const Mesh& mesh);
/// Closed, and no vertex is farther outside any triangle's plane than `tolerance` times the diagonal of the bounds.
bool is_convex(const Mesh& mesh, double tolerance = 1e-6);
/// m^3, of a closed mesh; negative when it looks inward.
double volume_of(const Mesh& mesh);

/// Joins equal vertices, and removes triangles without an area and vertices without a triangle.
void clean(Mesh& mesh);

}  // namespace muro::mesh
