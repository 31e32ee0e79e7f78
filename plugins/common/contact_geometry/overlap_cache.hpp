// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// Broad phase: finds which robots and which colliders of the scenery a robot's fat AABB overlaps. Overlaps are kept
/// while robots stay in their fat AABBs, so that most steps need no search. The cache is complete, and each pair is
/// tested with tight bounds before it is used, so results do not depend on the cache.
class OverlapCache {
 public:
  /// Overlap of a robot with another robot.
  struct Overlap {
    std::uint32_t robot, pair;  ///< the other robot; number of the pair, the same for both, below pair_numbers()
  };
  struct Overlaps {
    std::vector<std::uint32_t> scenery;  ///< colliders, by rising number
    std::vector<Overlap> robots;
    bool scenery_is_stale = true;  ///< `scenery` is that of an earlier fat AABB
  };

  /// Empties the cache. `scenery[k]`: bounds of collider k, for all colliders of the scenery. `unbounded`, by robot:
  /// not 0 for robots that overlap every other robot.
  void start(const SceneIndex& scene, std::vector<Aabb> scenery, std::vector<std::uint8_t> unbounded);
  /// Must be called in each step. Finds the pairs of robots whose fat AABB has changed.
  void update(const SceneIndex& scene);
  /// Returns overlaps with `scenery` up to date. Several threads may call it at the same time, each for different
  /// robots.
  const Overlaps& of(std::uint32_t robot, const SceneIndex& scene) {
    Overlaps& overlaps = of_[robot];
    if (overlaps.scenery_is_stale) find_scenery(overlaps, scene.robots[robot].fat_aabb, scene.scenery);
    return overlaps;
  }
  const std::vector<Overlap>& robots_of(std::uint32_t robot) const { return of_[robot].robots; }
  /// Whether any two robots overlap.
  bool any_robots() const { return numbers_ > free_.size(); }
  /// Returns a bound of the numbers of pairs. A pair keeps its number while it overlaps; then another pair may get it.
  std::uint32_t pair_numbers() const { return numbers_; }

 private:
  void find_scenery(Overlaps& overlaps, const Aabb& fat_aabb, const Bvh& tree) const;
  void add_pair(std::uint32_t a, std::uint32_t b);
  void remove_pairs_of(std::uint32_t robot);

  std::vector<Aabb> scenery_;
  std::vector<Overlaps> of_;            ///< by robot; each pair is in the entries of both
  std::vector<std::uint64_t> changes_;  ///< of fat AABBs, by robot: changes that are accounted for
  std::vector<std::uint32_t> changed_;  ///< robots of the present update
  std::vector<std::uint32_t> hidden_;   ///< robots that are not in the scene's tree: shadows
  std::uint64_t all_changes_ = 0;
  std::vector<std::uint8_t> unbounded_;  ///< by robot
  std::uint32_t numbers_ = 0;            ///< numbers of pairs given so far
  std::vector<std::uint32_t> free_;      ///< numbers that no pair has
};

}  // namespace muro::contact_geometry
