// SPDX-License-Identifier: MIT
// Surfaces as a GPU draws them: triangles, counter-clockwise seen from outside.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plugins/common/mesh/submesh.hpp"

namespace muro::render {

struct Vertex {
  std::array<float, 3> position{};
  std::array<float, 3> normal{};               ///< unit
  std::array<float, 2> texture_coordinates{};  ///< across and down, 0..1
};

struct Surface {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
  std::int32_t texture = -1;           ///< number in Scene::textures; -1: none
  bool repeats = true;                 ///< the texture, beyond its edges; else these go on
};

/// Edges of length 1, about the origin.
Surface unit_box();
/// Radius 1; `n` corners around it, half as many from pole to pole.
Surface unit_sphere(int n);
/// Radius 1, z in -0.5 .. 0.5, with its ends.
Surface unit_cylinder(int n);
/// The same without its ends.
Surface unit_tube(int n);
/// The upper half of a sphere of radius 1.
Surface unit_dome(int n);
/// x, y in -1 .. 1, z = 0, looking up: squares around squares, each a quarter as wide as the next, so that triangles
/// near the middle are small and interpolation in single precision is exact there.
Surface unit_ground();
/// Corners of triangles that meet at less than 40 degrees share a normal.
Surface surface_of(const mesh::Mesh& mesh);
Surface surface_of(const mesh::Submesh& part);

/// How many corners (16 .. 512, a multiple of 4) a polygon needs to lie at most `tolerance` (m) inside of a circle of
/// this radius (m).
int corners_for(double radius, double tolerance);

}  // namespace muro::render
