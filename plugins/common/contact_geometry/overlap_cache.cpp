// SPDX-License-Identifier: MIT
#include "overlap_cache.hpp"

#include <algorithm>

#include "box_tree.hpp"

namespace muro::contact_geometry {

void OverlapCache::start(const SceneIndex& scene, std::vector<Aabb> scenery, std::vector<std::uint8_t> unbounded) {
  scenery_ = std::move(scenery);
  unbounded_ = std::move(unbounded);
  of_.resize(scene.robots.size());
  for (Overlaps& overlaps : of_) {
    overlaps.scenery.clear();
    overlaps.robots.clear();
    overlaps.scenery.reserve(16);  // more is rare
    overlaps.robots.reserve(16);
    overlaps.scenery_is_stale = true;
  }
  changes_.assign(of_.size(), 0);
  changed_.reserve(of_.size());
  all_changes_ = 0;
  numbers_ = 0;
  free_.clear();
  free_.reserve(4 * of_.size());
  std::vector<bool> in_tree(of_.size());
  for (const std::uint32_t r : scene.moving.items) in_tree[r] = true;
  hidden_.clear();
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    if (!in_tree[r] && scene.robots[r].count > 0) hidden_.push_back(r);
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    for (std::uint32_t other = 0; other < of_.size() && unbounded_[r] != 0; ++other)
      if (other != r && (unbounded_[other] == 0 || r < other)) add_pair(r, other);
}

void OverlapCache::update(const SceneIndex& scene) {
  if (scene.all_changes == all_changes_) return;
  all_changes_ = scene.all_changes;
  changed_.clear();
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    if (scene.changes[r] != changes_[r]) changed_.push_back(r);
  for (const std::uint32_t r : changed_) {
    changes_[r] = scene.changes[r];
    of_[r].scenery_is_stale = true;
    if (unbounded_[r] != 0) continue;
    remove_pairs_of(r);
    const Aabb& fat_aabb = scene.robots[r].fat_aabb;
    const auto add_if_overlapping = [&](std::uint32_t other) {
      if (other != r && unbounded_[other] == 0 && scene.robots[other].fat_aabb.overlaps(fat_aabb)) add_pair(r, other);
    };
    each_near(scene.moving, fat_aabb, add_if_overlapping);
    for (const std::uint32_t other : hidden_) add_if_overlapping(other);
  }
}

void OverlapCache::add_pair(std::uint32_t a, std::uint32_t b) {
  std::uint32_t number = numbers_;
  if (free_.empty()) {
    ++numbers_;
  } else {
    number = free_.back();
    free_.pop_back();
  }
  of_[a].robots.push_back({b, number});
  of_[b].robots.push_back({a, number});
}

/// Removes the pairs of a robot, except those with unbounded robots.
void OverlapCache::remove_pairs_of(std::uint32_t robot) {
  std::erase_if(of_[robot].robots, [&](const Overlap& overlap) {
    if (unbounded_[overlap.robot] != 0) return false;
    std::vector<Overlap>& theirs = of_[overlap.robot].robots;
    *std::find_if(theirs.begin(), theirs.end(), [&](const Overlap& o) { return o.robot == robot; }) = theirs.back();
    theirs.pop_back();
    free_.push_back(overlap.pair);
    return true;
  });
}

void OverlapCache::find_scenery(Overlaps& overlaps, const Aabb& fat_aabb, const Bvh& tree) const {
  overlaps.scenery.clear();
  each_near(tree, fat_aabb, [&](std::uint32_t k) {
    if (scenery_[k].overlaps(fat_aabb)) overlaps.scenery.push_back(k);
  });
  std::sort(overlaps.scenery.begin(), overlaps.scenery.end());
  overlaps.scenery_is_stale = false;
}

}  // namespace muro::contact_geometry
