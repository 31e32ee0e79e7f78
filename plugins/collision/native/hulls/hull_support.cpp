// SPDX-License-Identifier: MIT
#include "hulls/hull_support.hpp"

#include <algorithm>

namespace muro::native {

HullSupport::HullSupport(const mesh::Hull& hull) : vertices_(hull.vertices) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const mesh::Hull::Face& f : hull.faces) {
    const std::span<const std::uint32_t> corners = hull.corners_of(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % corners.size()];
      edges.push_back({from, to});
      edges.push_back({to, from});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    first_.push_back(std::uint32_t(neighbours_.size()));
    for (auto e = std::lower_bound(edges.begin(), edges.end(), std::pair(v, 0U)); e != edges.end() && e->first == v;
         ++e)
      neighbours_.push_back(e->second);
  }
  first_.push_back(std::uint32_t(neighbours_.size()));
  for (int k = 0; k < 3; ++k) {
    of_axis_[k] = best_of_all(Vec3::Unit(k));
    of_axis_[k + 3] = best_of_all(-Vec3::Unit(k));
  }
  for (unsigned octant = 0; octant < 8; ++octant)
    of_octant_[octant] = best_of_all({octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0});
}

std::uint32_t HullSupport::best_of_all(const Vec3& direction) const {
  std::uint32_t best = 0;
  double farthest = vertices_[0].dot(direction);
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    const double out = vertices_[v].dot(direction);
    if (out > farthest) farthest = out, best = v;
  }
  return best;
}

std::uint32_t HullSupport::number_of(const Vec3& direction) const {
  if (vertices_.size() <= few) return best_of_all(direction);
  Vec3::Index axis;
  direction.cwiseAbs().maxCoeff(&axis);
  std::uint32_t best = of_axis_[direction[axis] < 0 ? axis + 3 : axis];
  const std::uint32_t diagonal =
      of_octant_[(direction.x() > 0 ? 1 : 0) | (direction.y() > 0 ? 2 : 0) | (direction.z() > 0 ? 4 : 0)];
  double farthest = vertices_[best].dot(direction);
  if (const double out = vertices_[diagonal].dot(direction); out > farthest) farthest = out, best = diagonal;
  for (bool rises = true; rises;) {
    rises = false;
    const std::uint32_t from = best;
    for (std::uint32_t e = first_[from]; e < first_[from + 1]; ++e) {
      const double out = vertices_[neighbours_[e]].dot(direction);
      if (out > farthest) farthest = out, best = neighbours_[e], rises = true;
    }
  }
  return best;
}

}  // namespace muro::native
