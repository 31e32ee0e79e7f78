// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <set>

#include "bounds.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/contact_geometry/box_tree.hpp"
#include "plugins/common/contact_geometry/robot_group.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::bvh {

using contact_geometry::BoxTree, contact_geometry::RobotGroup;

inline constexpr std::string_view version = "1.1.0";
extern const Description description;

/// Keeps the spatial index of the scene (sdk/muro/scene.hpp). In phase 0 the robots of each block get their AABBs,
/// eight robots of a group at once. In phase 1 robots that have left their fat AABBs get new ones, and the tree is
/// refitted.
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
  std::optional<Shape> bounding_shape(Connector& c, ObjectId body, const Shape& shape);
  void update_bounds(Range block);
  void update_tree();
  void set_fat_aabb(std::uint32_t robot);

  double margin_ = 0;
  const BoundsKernels* kernels_ = nullptr;
  Out<SceneIndex> index_;
  std::vector<Collider> colliders_;
  std::deque<Pose> scenery_poses_;
  std::vector<std::uint32_t> planes_;
  std::vector<RobotColliders> robots_;
  std::uint32_t scenery_ = 0;  ///< number of colliders of scenery, which come first

  mesh::Store meshes_;
  heightmap::Store heightmaps_;
  std::vector<Shape> bounding_shapes_;  ///< by collider: its shape; of a mesh or heightmap the bounding box

  std::vector<RobotGroup<std::vector<RoundedBox>>> groups_;  ///< groups of robots that have bounds
  std::vector<RobotPoses> poses_;                            ///< by robot
  std::vector<const RobotView*> views_;                      ///< by robot, for messages

  std::vector<std::uint32_t> members_;  ///< robots that have bounds
  std::vector<std::uint32_t> in_tree_;  ///< members that others touch and see
  std::set<std::uint32_t> shadows_;     ///< the other members
  std::vector<std::uint8_t> outside_;   ///< by robot: is not within its fat AABB
  std::vector<std::uint64_t> changes_;  ///< number of changes of fat AABBs, by robot
  std::uint64_t all_changes_ = 0;       ///< sum of changes_
  BoxTree scenery_tree_, moving_tree_;  ///< moving_tree_ holds fat AABBs
};

}  // namespace muro::bvh
