// SPDX-License-Identifier: MIT
#pragma once

#include "encounters.hpp"
#include "lanes/ground.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/contact_geometry/neighbours.hpp"
#include "team.hpp"

namespace muro::native {

extern const Description collision_description;

/// Where robots touch. First the neighbours of robots that have left their rooms are found; then each block of robots
/// lists its robots' contacts: robots that can touch nothing but the planes of the scenery eight of a kind at once, the
/// others pair by pair. Both give the same bits where both could be used.
class NativeCollision final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override;
  void step(const Step& step, Range range) override;
  void restored() override { start(); }

 private:
  struct Robot {
    ListOut<Contact> list;        ///< empty: forces do not move it
    Poses poses;                  ///< of its bodies with shapes
    double* signature = nullptr;  ///< which points of its list's contacts touch; see GroundWork
    In<std::uint64_t> world;      ///< see keys::contact_world
    std::uint64_t key = 0;        ///< of two robots, the pair is worked out as the one with the lower key sees it
    bool has_plane = false;
    std::int32_t shadow_of = -1;  ///< robot; see keys::shadow_of
    bool wants_all = false;       ///< its motion, or what chooses that, reads the list
  };
  struct Lane;

  void start_scenery();
  void start_robots();
  void touch(Range block);
  bool alone(std::uint32_t robot, const Neighbours::Of& near) const;
  void touch_ground(Lane& lane) const;
  void list_ground(std::uint32_t robot) const;
  bool touch_pairs(std::uint32_t robot, const Neighbours::Of& near);
  void touch_other_worlds(std::uint32_t robot, const Neighbours::Of& near);
  bool may_touch(std::uint32_t robot, std::uint32_t mate) const;
  void add_mates(Encounters& encounters, std::uint32_t robot, const Neighbours::Of& near) const;
  void add_mate(Encounters& encounters, std::uint32_t robot, std::uint32_t mate) const;
  Near near(std::uint32_t collider) const;
  Aabb ball(std::uint32_t collider) const;
  bool precedes(std::uint32_t a, std::uint32_t b) const;
  int words(std::uint32_t solids) const;

  const GroundKernels* kernels_ = nullptr;
  In<SceneIndex> index_;
  std::vector<Robot> robots_;  ///< by number
  bool any_list_ = false;

  std::vector<Near> scenery_;          ///< by collider: where it stands
  std::vector<std::uint32_t> planes_;  ///< colliders of the scenery
  std::vector<Ground> grounds_;        ///< the same
  bool robots_have_planes_ = false;
  Neighbours neighbours_;

  std::vector<Team<std::vector<Solid>>> teams_;  ///< of robots that have a list
  std::vector<Solid> solids_;                    ///< of robots' colliders
  std::vector<double> reaches_;                  ///< of them, m: see reach_of()
  std::vector<double> signatures_;
};

}  // namespace muro::native
