// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "axis.hpp"
#include "muro/connector.hpp"

namespace muro::joints {

/// With which a member of a group stands for components of the velocity of the base.
inline constexpr std::string_view base_member = "command.twist";

/// Everything of one robot that clients may read and set: its joints and the velocity of its base. Made when a group
/// asks for it.
class Axes {
 public:
  /// How many states a robot needs.
  static std::uint32_t count_states(const RobotView& robot) { return std::uint32_t(robot.links.size()) + 6; }

  /// `states`: as many as count_states says. When all have connected.
  Axes(Connector& connector, const RobotView& robot, AxisState* states);

  /// What a member of a group stands for: the name of a joint, a pattern of such names, "command.twist" for vx, vy and
  /// wz, "command.twist.vx" and the like for one component. Throws Error where there is none, or where it is neither
  /// read nor set. [setup]
  std::vector<Axis*> find(const std::string& member);
  /// All joints that are read or set, in the order of links, without those that follow others. [setup]
  std::vector<Axis*> all_joints();
  /// Whether something of the robot takes command.twist from clients. [setup]
  bool commands_base() const { return commands_base_; }

  /// Those that were found; valid as long as the states.
  std::vector<std::unique_ptr<Axis>> take_all() { return std::move(all_); }

 private:
  std::vector<Axis*> find_base(const std::string& member);
  std::vector<Axis*> find_joints(const std::string& member);
  Axis* joint(std::uint32_t link);
  Axis* base_component(std::uint32_t component);
  void connect_joint(Axis& axis, const Link& link);
  std::string local_name(const Link& link) const;
  bool has(ObjectId object, std::string_view property) const;
  bool is_wanted(ObjectId object, const KeyInfo& key) const;
  bool is_written(ObjectId object, const KeyInfo& key) const;

  Connector& connector_;
  const RobotView& robot_;
  AxisState* states_;
  bool commands_base_;
  std::vector<std::unique_ptr<Axis>> all_;
  std::vector<Axis*> by_place_;  ///< one a state; null: not asked for yet
};

}  // namespace muro::joints
