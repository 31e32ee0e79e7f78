// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/mesh/hull.hpp"

namespace muro::native {

/// Finds the vertex of a hull that lies farthest in a direction: of a small one by looking at all, of a large one by
/// walking uphill along its edges, from one of fourteen vertices that are known.
class HullSupport {
 public:
  /// Keeps a reference to the vertices. [setup]
  explicit HullSupport(const mesh::Hull& hull);

  /// The vertex (m, in the frame of the hull) that lies farthest along a direction of any length but zero.
  const Vec3& operator()(const Vec3& direction) const { return vertices_[number_of(direction)]; }

 private:
  static constexpr std::size_t few = 24;
  std::uint32_t number_of(const Vec3& direction) const;
  std::uint32_t best_of_all(const Vec3& direction) const;

  const std::vector<Vec3>& vertices_;
  std::vector<std::uint32_t> first_;       ///< of each vertex in `neighbours_`; and the end
  std::vector<std::uint32_t> neighbours_;  ///< those that share an edge
  std::uint32_t of_axis_[6];               ///< farthest along x, y, z, -x, -y, -z
  std::uint32_t of_octant_[8];             ///< farthest along the diagonals; bit k: along axis k
};

}  // namespace muro::native
