// SPDX-License-Identifier: MIT
#include "neighbours.hpp"

#include <algorithm>

#include "box_tree.hpp"

namespace muro::encounters {

void Neighbours::start(const SceneIndex& scene, std::vector<Aabb> scenery) {
  scenery_ = std::move(scenery);
  of_.resize(scene.robots.size());
  for (Of& near : of_) {
    near.scenery.clear();
    near.mates.clear();
    near.scenery.reserve(16);  // more is rare
    near.mates.reserve(16);
    near.stale = true;
  }
  changes_.assign(of_.size(), 0);
  changed_.reserve(of_.size());
  all_changes_ = 0;
  std::vector<bool> seen(of_.size());
  for (const std::uint32_t r : scene.moving.items) seen[r] = true;
  unseen_.clear();
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    if (!seen[r] && scene.robots[r].count > 0) unseen_.push_back(r);
}

void Neighbours::update(const SceneIndex& scene) {
  if (scene.all_changes == all_changes_) return;
  all_changes_ = scene.all_changes;
  changed_.clear();
  for (std::uint32_t r = 0; r < of_.size(); ++r)
    if (scene.changes[r] != changes_[r]) changed_.push_back(r);
  for (const std::uint32_t r : changed_) {
    changes_[r] = scene.changes[r];
    of_[r].stale = true;
    part(r);
    const Aabb& room = scene.robots[r].fat_aabb;
    each_near(scene.moving, room, [&](std::uint32_t mate) {
      if (mate == r || !scene.robots[mate].fat_aabb.overlaps(room)) return;
      of_[r].mates.push_back(mate);
      of_[mate].mates.push_back(r);
    });
    for (const std::uint32_t mate : unseen_) {
      if (mate == r || !scene.robots[mate].fat_aabb.overlaps(room)) continue;
      of_[r].mates.push_back(mate);
      of_[mate].mates.push_back(r);
    }
  }
}

/// Of all its mates.
void Neighbours::part(std::uint32_t robot) {
  for (const std::uint32_t mate : of_[robot].mates) {
    std::vector<std::uint32_t>& theirs = of_[mate].mates;
    *std::find(theirs.begin(), theirs.end(), robot) = theirs.back();
    theirs.pop_back();
  }
  of_[robot].mates.clear();
}

void Neighbours::find_scenery(Of& near, const Aabb& room, const Bvh& tree) const {
  near.scenery.clear();
  each_near(tree, room, [&](std::uint32_t k) {
    if (scenery_[k].overlaps(room)) near.scenery.push_back(k);
  });
  std::sort(near.scenery.begin(), near.scenery.end());
  near.stale = false;
}

}  // namespace muro::encounters
