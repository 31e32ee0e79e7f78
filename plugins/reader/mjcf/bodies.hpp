// SPDX-License-Identifier: MIT
// Which bodies of a compiled model are robots, and which are scenery.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "library.hpp"

namespace muro::mjcf {

/// Names of parts of a robot, or of objects of a world: what muro's names do not have is `_`.
class Names {
 public:
  /// `wanted`, followed by `suffix` as often as it takes to be unique.
  std::string unique(std::string_view wanted, std::string_view suffix = "_");

 private:
  std::set<std::string> taken_;
};

/// The bodies right under the world's, in the order of the file.
std::vector<int> top_bodies(const mjModel& m);
/// A body and all that hang on it, in the order of the file.
std::vector<int> subtree(const mjModel& m, int top);
/// Whether a body or one that hangs on it has a joint.
bool can_move(const mjModel& m, int top);
/// Whether it moves freely in the world.
bool is_free(const mjModel& m, int body);
/// The pose in the world of a body that no joint moves, or of one as the file shows it.
Pose pose_in_world(const mjModel& m, int body);
/// The name of a body, or "body_3".
std::string body_name(const mjModel& m, int body);
/// The name of a joint, or that of its body with `_joint`.
std::string joint_name(const mjModel& m, int joint);

}  // namespace muro::mjcf
