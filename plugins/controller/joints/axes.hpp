// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "axis.hpp"
#include "muro/connector.hpp"

namespace muro::joints {

/// Name by which a member of a group refers to components of the velocity of the base.
inline constexpr std::string_view base_member = "command.twist";

/// All axes of one robot that clients may read and set: its joints and the velocity of its base. An axis is made when a
/// group asks for it.
class Axes {
 public:
  /// Returns the number of states that a robot needs.
  static std::uint32_t count_states(const RobotView& robot) { return std::uint32_t(robot.links.size()) + 6; }

  /// `states`: count_states() states. Constructed after all algorithms have connected.
  Axes(Connector& connector, const RobotView& robot, AxisState* states);

  /// Returns the axes that a member of a group names. A member is the name of a joint, a pattern of such names,
  /// "command.twist" for vx, vy and wz, or "command.twist.vx" (and so on) for one component. Throws Error when there is
  /// no such axis, or when it can be neither read nor set. [setup]
  std::vector<Axis*> find(const std::string& member);
  /// Returns all joints that can be read or set, in the order of links, without joints that follow others. [setup]
  std::vector<Axis*> all_joints();
  /// Whether the robot has a part that takes command.twist from clients. [setup]
  bool commands_base() const { return commands_base_; }

  /// Returns the axes that were found; valid while the states exist.
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
  std::vector<Axis*> by_place_;  ///< one for each state; null: no axis yet
};

}  // namespace muro::joints
