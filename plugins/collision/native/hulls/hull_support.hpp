// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/mesh/hull.hpp"

namespace muro::native {

/// Finds the vertex of a hull that lies farthest in a direction. In a small hull it compares all vertices. In a large
/// hull it walks uphill along the edges, starting from one of fourteen known vertices.
class HullSupport {
 public:
  /// Keeps a reference to the vertices. [setup]
  explicit HullSupport(const mesh::Hull& hull);

  /// Returns the vertex (m, in the frame of the hull) that lies farthest along a direction of any length but zero.
  const Vec3& operator()(const Vec3& direction) const { return vertices_[number_of(direction)]; }

 private:
  static constexpr std::size_t few = 24;
  std::uint32_t number_of(const Vec3& direction) const;
  std::uint32_t best_of_all(const Vec3& direction) const;

  const std::vector<Vec3>& vertices_;
  std::vector<std::uint32_t> first_;       ///< index in `neighbours_`, for each vertex; then the end
  std::vector<std::uint32_t> neighbours_;  ///< vertices that share an edge with each vertex
  std::uint32_t of_axis_[6];               ///< vertices farthest along x, y, z, -x, -y, -z
  std::uint32_t of_octant_[8];             ///< vertices farthest along the diagonals; bit k: along axis k
};

}  // namespace muro::native
