// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// The broad phase: which robots and which colliders of the scenery a robot's fat AABB overlaps. Found once and kept
/// while robots stay in their fat AABBs, so that most steps need no search. The cache is complete and each pair is
/// tested with tight bounds before it is used, so results do not depend on it.
class OverlapCache {
 public:
  /// Of a robot with another.
  struct Overlap {
    std::uint32_t robot, pair;  ///< the other; number of the pair, the same for both, below pair_numbers()
  };
  struct Overlaps {
    std::vector<std::uint32_t> scenery;  ///< colliders, by rising number
    std::vector<Overlap> robots;
    bool scenery_is_stale = true;  ///< `scenery` is that of an earlier fat AABB
  };

  /// Empties the cache. `scenery[k]`: the bounds of collider k, for all colliders of the scenery. `unbounded`: by
  /// robot, not 0 for those that overlap every other.
  void start(const SceneIndex& scene, std::vector<Aabb> scenery, std::vector<std::uint8_t> unbounded);
  /// To be called in each step: finds the pairs of robots whose fat AABB has changed.
  void update(const SceneIndex& scene);
  /// With `scenery` up to date. Several threads may ask at the same time, each for other robots.
  const Overlaps& of(std::uint32_t robot, const SceneIndex& scene) {
    Overlaps& overlaps = of_[robot];
    if (overlaps.scenery_is_stale) find_scenery(overlaps, scene.robots[robot].fat_aabb, scene.scenery);
    return overlaps;
  }
  const std::vector<Overlap>& robots_of(std::uint32_t robot) const { return of_[robot].robots; }
  /// Whether any two robots overlap.
  bool any_robots() const { return numbers_ > free_.size(); }
  /// A pair has its number as long as it overlaps; then another may have it.
  std::uint32_t pair_numbers() const { return numbers_; }

 private:
  void find_scenery(Overlaps& overlaps, const Aabb& fat_aabb, const Bvh& tree) const;
  void add_pair(std::uint32_t a, std::uint32_t b);
  void remove_pairs_of(std::uint32_t robot);

  std::vector<Aabb> scenery_;
  std::vector<Overlaps> of_;            ///< by robot; each pair stands with both
  std::vector<std::uint64_t> changes_;  ///< of fat AABBs, by robot: those that are accounted for
  std::vector<std::uint32_t> changed_;  ///< robots of the present update
  std::vector<std::uint32_t> hidden_;   ///< robots that the scene's tree does not have: shadows
  std::uint64_t all_changes_ = 0;
  std::vector<std::uint8_t> unbounded_;  ///< by robot
  std::uint32_t numbers_ = 0;            ///< of pairs, so far
  std::vector<std::uint32_t> free_;      ///< those that no pair has
};

}  // namespace muro::contact_geometry
