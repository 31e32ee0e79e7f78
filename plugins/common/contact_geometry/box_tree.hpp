// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// A bounding volume hierarchy over numbered boxes, less than 64 levels deep. Keeps its memory, so building it again
/// does not allocate.
class BoxTree {
 public:
  /// Builds the tree over `boxes[i]` for every i in `members`. The boxes must be finite.
  void build(std::span<const Aabb> boxes, std::span<const std::uint32_t> members);
  /// Changes box number `item`, and refits the nodes on the way to the root.
  void move(std::uint32_t item, const Aabb& box);
  /// Whether boxes have moved so far that a search costs much more than in a new tree.
  bool is_degraded() const { return cost_ > 1.5 * built_cost_; }
  /// Builds a new tree over the same members as they are now.
  void rebuild();

  Bvh view() const { return {nodes_, items_}; }

 private:
  void build_nodes();
  void split(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth);
  void refit(std::uint32_t node);

  std::vector<Aabb> boxes_;
  std::vector<BvhNode> nodes_;  ///< children come after their parents
  std::vector<std::uint32_t> items_;
  std::vector<std::uint32_t> parents_;  ///< of nodes; the root's is itself
  std::vector<std::uint32_t> leaves_;   ///< of items
  double cost_ = 0;                     ///< cost of a search: the surface of all nodes
  double built_cost_ = 0;               ///< the cost when it was built
};

/// Calls `visit(item)` for the items of all leaves whose bounds overlap `box`. The bounds of items are not checked.
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

}  // namespace muro::contact_geometry
