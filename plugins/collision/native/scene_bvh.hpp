// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <set>

#include "lanes/bounds.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/contact_geometry/box_tree.hpp"
#include "plugins/common/mesh/store.hpp"
#include "team.hpp"

namespace muro::native {

using encounters::BoxTree;

extern const Description scene_bvh_description;

/// Keeps the spatial index of the scene (sdk/muro/scene.hpp). First every block of robots brings its robots' boxes up
/// to date, eight robots of a kind at once; then those that have left their rooms get new ones, and the tree follows.
class SceneBvh final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override;
  void step(const Step& step, Range range) override;
  void restored() override { start(); }

 private:
  void add_scenery(Connector& c);
  void add_robot(Connector& c, const RobotView& robot);
  void add_colliders(Connector& c, ObjectId body, const Pose* pose);
  std::optional<Shape> outline(Connector& c, ObjectId body, const Shape& shape);
  void bound(Range block);
  void make_room();
  void new_room(std::uint32_t robot);

  double margin_ = 0;
  const BoundsKernels* kernels_ = nullptr;
  Out<SceneIndex> index_;
  std::vector<Collider> colliders_;
  std::deque<Pose> scenery_poses_;
  std::vector<std::uint32_t> planes_;
  std::vector<RobotColliders> robots_;
  std::uint32_t scenery_ = 0;  ///< the first so many colliders stand still

  mesh::Store meshes_;
  std::set<std::string> unread_;  ///< mesh files warned of
  std::vector<Shape> outlines_;   ///< by collider: what bounds it; of a mesh the box around it

  std::vector<Team<std::vector<Part>>> teams_;  ///< of robots that have bounds
  std::vector<Poses> poses_;                    ///< by robot

  std::vector<std::uint32_t> members_;  ///< robots that have bounds
  std::vector<std::uint32_t> seen_;     ///< those of them that are in the tree
  std::set<std::uint32_t> shadows_;     ///< the others: nobody sees them
  std::vector<std::uint8_t> left_;      ///< by robot: is not within its room
  std::vector<std::uint64_t> changes_;  ///< of rooms, by robot
  std::uint64_t all_changes_ = 0;       ///< their sum
  BoxTree scenery_tree_, moving_tree_;  ///< the second: of rooms
};

}  // namespace muro::native
