// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <deque>

#include "meshes.hpp"
#include "solver.hpp"

namespace muro::bullet {

/// A world made of Bullet's parts: its shapes and narrow phase, its articulated bodies, its solver.
///
/// A step follows from the state of the robots alone: bodies are set anew in each, contacts are found anew, in the
/// order of pairs of shapes, and the solver begins with the impulses that the robots remember. Robots that touch each
/// other are solved together, all others alone.
class BulletWorld final : public multibody::World {
 public:
  BulletWorld(const Settings& settings, std::shared_ptr<const Meshes> meshes);

  void add_scenery(const multibody::Fixture& fixture) override;
  void add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  /// A robot or obstacle with the colliders `first` to `first + count`.
  struct Group {
    std::uint32_t first = 0, count = 0;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m: around all
    bool present = false, simulated = false;
    Vec3 room_low = Vec3::Zero(), room_high = Vec3::Constant(-1);  ///< m: in which `near` holds
    std::vector<std::uint32_t> near;                               ///< scenery
  };
  struct Pair {
    const Collider *a, *b;
  };
  struct Island {
    std::uint32_t robot, root;
  };

  Collider& add_collider(const multibody::PartShape& shape, bool moves);
  void move(Group& group, const multibody::PartMotion* parts);
  void find_pairs();
  void find_scenery(Group& group);
  void meet(const Group& a, const Group& b);
  void meet_itself(const Group& group, const Robot& robot);
  void find_touches(double dt);
  multibody::PartMotion motion_of(const Collider& c) const;
  void find_islands();
  void solve(std::span<const Island> robots, double dt);
  std::span<Touch> touches_of(std::uint32_t robot);
  void export_contacts(double dt);

  Settings settings_;
  std::shared_ptr<const Meshes> meshes_;
  std::deque<Collider> colliders_;
  std::deque<Robot> robots_;
  std::vector<Memory> memories_;
  std::vector<const multibody::FixtureState*> obstacles_;
  std::vector<Group> groups_;  ///< robots, then obstacles
  std::vector<std::uint32_t> planes_, order_;
  btDbvt scenery_;
  NarrowPhase narrow_phase_;
  Solver solver_;
  Scratch scratch_;
  std::vector<Pair> pairs_;
  std::vector<Touch> touches_;
  std::vector<std::uint32_t> first_touch_;  ///< of each robot, as `a`; one more than there are robots
  std::vector<Island> islands_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace muro::bullet
