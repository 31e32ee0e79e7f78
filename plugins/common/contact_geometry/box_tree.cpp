// SPDX-License-Identifier: MIT
#include "box_tree.hpp"

#include <algorithm>

namespace muro::contact_geometry {

namespace {

constexpr std::uint32_t leaf_size = 2;
constexpr int bins = 8;
constexpr int deepest_cut = 31;  // deeper nodes are halved, at most 32 times

double surface(const Aabb& b) {
  const Vec3 d = (b.high - b.low).cwiseMax(0.0);
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

Vec3 middle(const Aabb& b) { return 0.5 * b.low + 0.5 * b.high; }

/// Returns the bin of a centre at the distance `offset` from the first one. It is one of the bins for any numbers.
int bin_of(double offset, double width) {
  const double bin = bins * (offset / width);
  return bin > 0 ? (bin < bins ? int(bin) : bins - 1) : 0;
}

struct Cut {
  int axis = -1;
  double at = 0;
};

/// Finds the split that costs least by the surface area heuristic (Wald: On fast construction of SAH-based bounding
/// volume hierarchies, 2007).
Cut best_cut(std::span<const std::uint32_t> items, std::span<const Aabb> boxes) {
  Aabb centres;
  for (const std::uint32_t i : items) centres.include({middle(boxes[i]), middle(boxes[i])});
  Cut best;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = centres.low[axis], width = centres.high[axis] - low;
    if (!(width > 0)) continue;
    Aabb bounds[bins];
    int counts[bins] = {};
    for (const std::uint32_t i : items) {
      const int b = bin_of(middle(boxes[i])[axis] - low, width);
      bounds[b].include(boxes[i]);
      ++counts[b];
    }
    for (int cut = 1; cut < bins; ++cut) {
      Aabb sides[2];
      int n[2] = {};
      for (int b = 0; b < bins; ++b) {
        if (counts[b] == 0) continue;
        sides[b >= cut].include(bounds[b]);
        n[b >= cut] += counts[b];
      }
      if (n[0] == 0 || n[1] == 0) continue;
      const double cost = surface(sides[0]) * n[0] + surface(sides[1]) * n[1];
      if (cost < least) {
        least = cost;
        best = {axis, low + width * cut / bins};
      }
    }
  }
  return best;
}

}  // namespace

void BoxTree::build(std::span<const Aabb> boxes, std::span<const std::uint32_t> members) {
  boxes_.assign(boxes.begin(), boxes.end());
  items_.assign(members.begin(), members.end());
  leaves_.resize(boxes.size());
  build_nodes();
}

void BoxTree::rebuild() {
  std::sort(items_.begin(), items_.end());  // a tree depends only on its boxes
  build_nodes();
}

void BoxTree::build_nodes() {
  nodes_.clear();
  parents_.clear();
  cost_ = built_cost_ = 0;
  if (items_.empty()) return;
  nodes_.reserve(2 * items_.size());
  parents_.reserve(2 * items_.size());
  nodes_.emplace_back();
  parents_.push_back(0);
  split(0, 0, std::uint32_t(items_.size()), 0);
  for (const BvhNode& n : nodes_) built_cost_ += surface(n.bounds);
  cost_ = built_cost_;
}

void BoxTree::split(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth) {
  const std::span<std::uint32_t> items(items_.data() + first, count);
  Aabb bounds;
  for (const std::uint32_t i : items) bounds.include(boxes_[i]);
  nodes_[node] = {bounds, first, count};
  if (count <= leaf_size) {
    for (const std::uint32_t i : items) leaves_[i] = node;
    return;
  }
  const Cut cut = depth < deepest_cut ? best_cut(items, boxes_) : Cut{};
  auto second = items.begin() + count / 2;  // all centres in one place, or too deep: any halves do
  if (cut.axis >= 0)
    second = std::partition(items.begin(), items.end(),
                            [&](std::uint32_t i) { return middle(boxes_[i])[cut.axis] < cut.at; });
  auto left = std::uint32_t(second - items.begin());
  if (left == 0 || left == count) left = count / 2;  // rounding at the boundary of a bin
  const auto children = std::uint32_t(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  parents_.resize(nodes_.size(), node);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  split(children, first, left, depth + 1);
  split(children + 1, first + left, count - left, depth + 1);
}

void BoxTree::refit(std::uint32_t node) {
  BvhNode& n = nodes_[node];
  cost_ -= surface(n.bounds);
  n.bounds = {};
  if (n.count > 0)
    for (std::uint32_t i = 0; i < n.count; ++i) n.bounds.include(boxes_[items_[n.first + i]]);
  else
    for (const std::uint32_t child : {n.first, n.first + 1}) n.bounds.include(nodes_[child].bounds);
  cost_ += surface(n.bounds);
}

void BoxTree::move(std::uint32_t item, const Aabb& box) {
  boxes_[item] = box;
  std::uint32_t node = leaves_[item];
  for (refit(node); node != 0; refit(node)) node = parents_[node];
}

}  // namespace muro::contact_geometry
