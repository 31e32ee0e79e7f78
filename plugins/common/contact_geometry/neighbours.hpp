// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"

namespace muro::encounters {

/// Who is near whom: found once and kept while robots stay in their rooms, so that most steps need no search. What is
/// kept is complete, and tested before it is used, so it never decides about a result.
class Neighbours {
 public:
  struct Of {
    std::vector<std::uint32_t> scenery;  ///< colliders whose bounds the robot's room overlaps, by rising number
    std::vector<std::uint32_t> mates;    ///< robots whose rooms it overlaps
    bool stale = true;                   ///< `scenery` is of an earlier room
  };

  /// Forgets everything. `scenery[k]`: the bounds of collider k, as far as colliders are scenery.
  void start(const SceneIndex& scene, std::vector<Aabb> scenery);
  /// To be called in each step: mates of robots whose room has changed, and theirs.
  void update(const SceneIndex& scene);
  /// With `scenery` up to date. Robots may be asked for at the same time from several threads.
  const Of& of(std::uint32_t robot, const SceneIndex& scene) {
    Of& near = of_[robot];
    if (near.stale) find_scenery(near, scene.robots[robot].fat_aabb, scene.scenery);
    return near;
  }

 private:
  void find_scenery(Of& near, const Aabb& room, const Bvh& tree) const;
  void part(std::uint32_t robot);

  std::vector<Aabb> scenery_;
  std::vector<Of> of_;                  ///< by robot; mates know each other
  std::vector<std::uint64_t> changes_;  ///< of rooms, by robot: those that are accounted for
  std::vector<std::uint32_t> changed_;  ///< of the present update
  std::vector<std::uint32_t> unseen_;   ///< robots that the scene's tree does not have: shadows
  std::uint64_t all_changes_ = 0;
};

}  // namespace muro::encounters
