// SPDX-License-Identifier: MIT
// A model: what robots that kernels move together have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "joint_properties.hpp"
#include "move.hpp"

namespace muro::simplified {

/// Robots with the same masses and joints, whose joints lie in memory in the same way.
struct Model {
  RigidMass mass;
  /// Joints that kernels move; those of one mode.
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

  /// Adds the groups of a robot, whose joints accelerate by at most `acceleration` (rad/s^2 or m/s^2). Returns where
  /// the state of each lies, at least one; the first is `base` with the joints of the first group. [setup]
  std::vector<RobotState> add_groups(const RobotView& robot, const std::vector<JointProperties>& properties,
                                     double acceleration, const RobotState& base);

  /// Puts the joints of a group into `batch`, if there is this group.
  void set_joints(BatchParameters& batch, std::size_t group) const {
    if (group >= groups.size()) return;
    batch.mode = groups[group].mode;
    batch.joints = groups[group].joints.data();
    batch.joint_count = int(groups[group].joints.size());
  }
};

/// The mass properties of a robot, all of whose bodies together have the inertia `total` in the frame of the base.
/// Throws Error when the mass or a principal moment is not positive. [setup]
RigidMass rigid_mass(const RobotView& robot, const Inertia& total);

/// The number of the model among those that are known; a new one is added. [setup]
std::uint32_t number_of(Model model, std::vector<Model>& known);

}  // namespace muro::simplified
