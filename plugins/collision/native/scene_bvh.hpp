// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "box_tree.hpp"
#include "muro/algorithm.hpp"

namespace muro::native {

extern const Description scene_bvh_description;

/// Keeps the spatial index of the scene (sdk/muro/scene.hpp). Boxes of robots carry a margin; the tree is
/// touched only when a robot has left its box.
class SceneBvh final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  void step(const Step& step, Range range) override;
  void restored() override { start(); }

 private:
  void add_colliders(Connector& c, ObjectId body, const Pose* pose);
  void warn_of_mesh(Connector& c, ObjectId body, TextId mesh);
  void place(std::uint32_t robot);
  void rebuild();

  double margin_ = 0;
  Out<SceneIndex> index_;
  std::vector<Collider> colliders_;
  std::deque<Pose> scenery_poses_;
  std::vector<std::uint32_t> planes_;
  std::vector<RobotColliders> robots_;
  std::vector<Aabb> fat_;               ///< a robot's box with its margin, by robot number
  std::vector<std::uint32_t> members_;  ///< robots that have bounds
  std::uint32_t scenery_ = 0;           ///< the first so many colliders stand still
  std::size_t strayed_ = 0;             ///< robots that left their boxes since the tree was built
  std::uint64_t changes_ = 0;           ///< of boxes with margin
  std::vector<TextId> meshes_;          ///< warned of
  BoxTree scenery_tree_, moving_tree_;
};

}  // namespace muro::native
