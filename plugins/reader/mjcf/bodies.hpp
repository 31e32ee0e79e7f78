// SPDX-License-Identifier: MIT
// Finds which bodies of a compiled model are robots and which are scenery.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "library.hpp"

namespace muro::mjcf {

/// Unique names of parts of a robot, or of objects of a world. Characters that muro's names may not have become `_`.
class Names {
 public:
  /// Returns `wanted`, followed by `suffix` as often as needed to be unique.
  std::string unique(std::string_view wanted, std::string_view suffix = "_");

 private:
  std::set<std::string> taken_;
};

/// Returns the children of the world's body, in the order of the file.
std::vector<int> top_bodies(const mjModel& m);
/// Returns a body and all its descendants, in the order of the file.
std::vector<int> subtree(const mjModel& m, int top);
/// Whether a body or one of its descendants has a joint.
bool can_move(const mjModel& m, int top);
/// Whether a body moves freely in the world.
bool is_free(const mjModel& m, int body);
/// Returns the pose of a body in the world, at the reference positions of all joints.
Pose pose_in_world(const mjModel& m, int body);
/// Returns the name of a body, or "body_3".
std::string body_name(const mjModel& m, int body);
/// Returns the name of a joint, or the name of its body with `_joint`.
std::string joint_name(const mjModel& m, int joint);

}  // namespace muro::mjcf
