// SPDX-License-Identifier: MIT
// Hand-over during a run: robots that several motions can move, one at a time.
//
// Each motion of such a robot is connected to the same properties; `motion.level` says which of them steps the robot.
// When `motion.level.target` names another motion, that one takes over before anything that depends on it runs in this
// instant. Control code writes `motion.level.target`. An algorithm that follows rules writes `motion.level.rule`, which
// has priority while it names a motion. The state stays in the same memory. Properties that describe the motion
// (Role::motion_trait) are set to zero when the new motion does not write them; a motion that has them writes them anew
// (Algorithm::on_handover).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/instance.hpp"

namespace muro {

/// The motions of one robot.
struct LevelsOfRobot {
  const RobotView* robot = nullptr;
  std::vector<std::string> names;
  std::uint32_t first = 0;  ///< the motion that moves it at the start
};

/// The algorithm that carries out hand-overs.
class Levels final : public abi::AlgorithmInstance {
 public:
  Levels();
  ~Levels();
  Levels(const Levels&) = delete;
  Levels& operator=(const Levels&) = delete;
  /// Creates the properties of all robots with levels, and lets their motions write the same properties. Call before
  /// motions are connected.
  void prepare(World& world, const std::vector<LevelsOfRobot>& robots, std::span<const std::unique_ptr<Instance>> all);
  /// Finds what each motion writes. Call when the motions are connected.
  void complete(World& world);
  bool empty() const { return robots_.empty(); }
  /// Whether another level than `level` moves the robot at the start.
  bool is_inactive_at_start(RobotId robot, std::uint32_t level) const;

  /// Properties that a hand-over writes in addition to those that the motions write. An algorithm that decides about
  /// levels does not wait for the hand-over of the instant: when it reads one of these properties, the hand-over need
  /// not run first.
  std::vector<SlotId> written() const;
  /// The task of the hand-over: on demand, before the tasks that read which motion moves a robot.
  Task task(std::span<const std::unique_ptr<Instance>> all);
  /// Returns the object that steps an instance. It is the instance itself or, when another motion may move one of its
  /// robots, a level filter that steps the items that the instance moves at present.
  abi::AlgorithmInstance* filter_of(Instance& instance);

 private:
  bool connect(Connector&, abi::ErrorText&) noexcept override { return true; }
  bool connect_by_name(Connector&, abi::ErrorText&) noexcept override { return true; }
  bool start(abi::ErrorText&) noexcept override { return true; }
  Rows<Phase> phases() const noexcept override { return {}; }
  bool step(const Step& step, Range range, abi::ErrorText& error) noexcept override;
  bool restored(abi::ErrorText&) noexcept override { return true; }
  bool finish(abi::ErrorText&) noexcept override { return true; }
  void destroy() noexcept override {}
  bool on_handover(std::uint32_t, abi::ErrorText&) noexcept override { return true; }
  void* find_extension(const ExtensionId&) noexcept override { return nullptr; }

  struct Mover {
    Instance* instance = nullptr;
    std::uint32_t item = 0;
    std::vector<SlotId> lacks;  ///< Role::motion_trait, written only by other motions of the robot
  };
  struct Robot {
    const RobotView* view;
    std::uint32_t first;
    std::vector<Mover> movers;  ///< by level
    std::uint32_t* level;
    const std::int32_t* target;
    const std::int32_t* rule;  ///< written by an algorithm that follows rules; -1: no rule applies
    SlotId level_slot, target_slot, rule_slot;
    std::vector<SlotId> traits;  ///< Role::motion_trait, written by any of the motions
  };
  class LevelFilter;

  static std::vector<Mover> movers_of(const LevelsOfRobot& setup, std::span<const std::unique_ptr<Instance>> all);
  static void add_properties(World& world, Accessor accessor, const std::vector<std::string>& names, Robot& r);
  Robot* find(RobotId id);
  const Robot* find(RobotId id) const;
  std::vector<SlotId> traits_of(const World& world, const Robot& robot, const Mover& mover) const;

  PropertyStore* store_ = nullptr;
  std::vector<Robot> robots_;
  std::vector<std::unique_ptr<LevelFilter>> filters_;
};

}  // namespace muro
