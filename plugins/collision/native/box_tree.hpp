// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"

namespace muro::native {

/// A hierarchy of boxes over numbered boxes, less than 64 levels deep. Keeps its memory, so building again
/// allocates nothing.
class BoxTree {
 public:
  /// Over `boxes[i]` for every i in `members`; boxes are finite.
  void build(std::span<const Aabb> boxes, std::span<const std::uint32_t> members);
  /// After boxes have changed: the same tree with new bounds.
  void refit(std::span<const Aabb> boxes);

  Bvh view() const { return {nodes_, items_}; }

 private:
  void split(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth, std::span<const Aabb> boxes);

  std::vector<BvhNode> nodes_;  ///< children behind their parents
  std::vector<std::uint32_t> items_;
};

/// Calls `visit(item)` for the items of all leaves that `box` overlaps. The leaves' bounds, not those of items, decide.
template <class Visit>
void each_near(const Bvh& tree, const Aabb& box, Visit visit) {
  if (tree.nodes.empty()) return;
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const BvhNode& n = tree.nodes[stack[--depth]];
    if (!n.bounds.overlaps(box)) continue;
    if (n.count > 0) {
      for (std::uint32_t i = 0; i < n.count; ++i) visit(tree.items[n.first + i]);
    } else {
      stack[depth++] = n.first + 1;
      stack[depth++] = n.first;
    }
  }
}

}  // namespace muro::native
