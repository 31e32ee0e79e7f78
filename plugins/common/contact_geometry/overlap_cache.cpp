// SPDX-License-Identifier: MIT
#include "overlap_cache.hpp"

#include <algorithm>

#include "box_tree.hpp"

namespace muro::contact_geometry {

void OverlapCache::start(const SceneIndex& scene, std::vector<Aabb> scenery) {
  scenery_ = std::move(scenery);
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
  pairs_ = 0;
  std::vector<bool> in_tree(of_.size());
  for (const std::uint32_t r : scene.moving.items) in_tree[r] = true;
  hidden_.clear();
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    if (!in_tree[r] && scene.robots[r].count > 0) hidden_.push_back(r);
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
    remove_pairs_of(r);
    const Aabb& fat_aabb = scene.robots[r].fat_aabb;
    const auto add_if_overlapping = [&](std::uint32_t other) {
      if (other != r && scene.robots[other].fat_aabb.overlaps(fat_aabb)) add_pair(r, other);
    };
    each_near(scene.moving, fat_aabb, add_if_overlapping);
    for (const std::uint32_t other : hidden_) add_if_overlapping(other);
  }
}

void OverlapCache::add_pair(std::uint32_t a, std::uint32_t b) {
  of_[a].robots.push_back(b);
  of_[b].robots.push_back(a);
  ++pairs_;
}

void OverlapCache::remove_pairs_of(std::uint32_t robot) {
  for (const std::uint32_t other : of_[robot].robots) {
    std::vector<std::uint32_t>& theirs = of_[other].robots;
    *std::find(theirs.begin(), theirs.end(), robot) = theirs.back();
    theirs.pop_back();
  }
  pairs_ -= of_[robot].robots.size();
  of_[robot].robots.clear();
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
