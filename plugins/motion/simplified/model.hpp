// SPDX-License-Identifier: MIT
// A model: the common data of robots that kernels move together.
#pragma once

#include <cstdint>
#include <vector>

#include "joint_properties.hpp"
#include "move.hpp"

namespace muro::simplified {

/// Data of robots with the same masses and joints and the same layout of joints in memory.
struct Model {
  RigidMass mass;
  /// Joints of one mode that kernels move.
  struct Group {
    Mode mode = Mode::velocity;
    std::vector<Joint> joints;
    bool operator==(const Group&) const = default;
  };
  std::vector<Group> groups;
  bool rigid = true;          ///< no joint moves mass
  bool force_driven = false;  ///< forces drive joints
  bool single_kernel = true;  ///< one call of a kernel moves it
  bool operator==(const Model&) const = default;

  /// Adds the groups of a robot. Its joints accelerate by at most `acceleration` (rad/s^2 or m/s^2). Returns the state
  /// addresses of each group, at least one; the first is `base` with the joints of the first group. [setup]
  std::vector<RobotState> add_groups(const RobotView& robot, const std::vector<JointProperties>& properties,
                                     double acceleration, const RobotState& base);

  /// Puts the joints of a group into `batch`, if the group exists.
  void set_joints(BatchParameters& batch, std::size_t group) const {
    if (group >= groups.size()) return;
    batch.mode = groups[group].mode;
    batch.joints = groups[group].joints.data();
    batch.joint_count = int(groups[group].joints.size());
  }
};

/// Returns the mass properties of a robot. `total`: inertia of all its bodies together in the frame of the base. Throws
/// Error when the mass or a principal moment is not positive. [setup]
RigidMass rigid_mass(const RobotView& robot, const Inertia& total);

/// Returns the number of the model among the known models; adds a new model. [setup]
std::uint32_t number_of(Model model, std::vector<Model>& known);

}  // namespace muro::simplified
