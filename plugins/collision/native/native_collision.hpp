// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/mesh_pairs.hpp"
#include "lanes/ground.hpp"
#include "pairs/conversions.hpp"
#include "plugins/common/contact_geometry/pair_collision.hpp"
#include "plugins/common/contact_geometry/robot_group.hpp"
#include "terrain/terrains.hpp"

namespace muro::native {

/// Collision detection of primitive shapes, meshes and heightmaps with its own narrow phase. A SIMD kernel finds the
/// contacts of robots with planes and heightmaps of the scenery, for eight robots of a group at once. Other contacts,
/// and those that the kernel cannot find, are found pair by pair. Both ways give the same bits where both can be used.
class NativeCollision final : public PairCollision {
 public:
  void connect(Connector& c) override;
  void start() override;

 private:
  /// Data of a robot for the ground kernel.
  struct GroundRobot {
    RobotPoses poses;              ///< of its bodies with shapes
    double* signature = nullptr;   ///< shows which points touch; see GroundBatch
    std::size_t words = 0;         ///< of the signature
    double* clearances = nullptr;  ///< see GroundBatch
  };
  struct Batch;

  TransformedShape transformed_shape(std::uint32_t collider) const override;
  void collide(const TransformedCollider& a, const TransformedCollider& b, std::vector<ContactPoint>& points) override;
  double distance_bound(const TransformedCollider& a, const TransformedCollider& b) const override;
  void list_contacts(Range robots) override;

  void collide_with_terrain(const TransformedCollider& a, const Terrain& terrain, std::vector<ContactPoint>& points,
                            bool is_left = false) const;
  void collide_meshes(const TransformedCollider& a, const TransformedCollider& b,
                      std::vector<ContactPoint>& points) const;
  void add_kernel_shapes();
  KernelShape kernel_shape(std::uint32_t collider, std::uint32_t body);
  void add_grounds();
  void group_robots();
  void allocate_signatures();
  void allocate_clearances();
  static void fetch(std::span<const KernelShape> shapes, const RobotPoses& poses, std::span<const Contact> contacts);
  bool takes_kernel(std::uint32_t robot) const;
  bool touches_only_ground(std::uint32_t robot);
  void find_ground_contacts(Batch& batch);
  void list_ground_contacts(std::uint32_t robot) const;
  void list_merged(std::uint32_t robot, Contact* found, const std::uint8_t* left, unsigned bit);
  template <class Visit>
  void each_slot(std::uint32_t robot, Visit visit) const;
  void collide_left(const TransformedCollider& own, const TransformedCollider& ground, Candidates& candidates);
  void add_other_scenery(std::uint32_t robot, Candidates& candidates);
  std::size_t signature_size(std::uint32_t robot) const;

  const GroundKernels* kernels_ = nullptr;
  MeshPairs meshes_;
  Terrains terrains_;
  std::vector<GroundRobot> ground_robots_;                    ///< by robot number
  std::vector<std::uint32_t> ground_colliders_;               ///< planes and heightmaps of the scenery, as indices
  bool has_grounds_of_one_object_ = false;                    ///< some object has several grounds
  std::vector<Ground> grounds_;                               ///< in the order of ground_colliders_
  std::vector<RobotGroup<std::vector<KernelShape>>> groups_;  ///< of robots that have a list
  std::vector<KernelShape> shapes_;                           ///< by collider
  std::vector<double> signatures_, clearances_;
  std::size_t most_ground_points_ = 0;  ///< most points that a kernel may find for a robot
};

}  // namespace muro::native
