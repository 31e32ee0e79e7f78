// SPDX-License-Identifier: MIT
// Surfaces in the form of a GPU: triangles, counter-clockwise seen from outside.
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
  bool repeats = true;                 ///< whether the texture repeats beyond its edges; else the edges go on
};

/// Returns a box with edges of length 1, about the origin.
Surface unit_box();
/// Returns a sphere of radius 1, with `n` corners around it and half as many from pole to pole.
Surface unit_sphere(int n);
/// Returns a cylinder of radius 1, z in -0.5 .. 0.5, with its ends.
Surface unit_cylinder(int n);
/// Returns the cylinder without its ends.
Surface unit_tube(int n);
/// Returns the upper half of a sphere of radius 1.
Surface unit_dome(int n);
/// Returns a plane that faces up: x, y in -1 .. 1, z = 0. It consists of squares around squares, each a quarter as wide
/// as the next, so that triangles near the middle are small and interpolation in single precision is exact there.
Surface unit_ground();
/// Returns the surface of a mesh. Corners of triangles that meet at less than 40 degrees share a normal.
Surface surface_of(const mesh::Mesh& mesh);
Surface surface_of(const mesh::Submesh& part);

/// Returns the number of corners (16 .. 512, a multiple of 4) of a polygon that lies at most `tolerance` (m) inside a
/// circle of this radius (m).
int corners_for(double radius, double tolerance);

}  // namespace muro::render
