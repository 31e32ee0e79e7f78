// SPDX-License-Identifier: MIT
// A robot's rigid bodies as the kernel sees them: what robots that are moved together have in common, and their masses.
#pragma once

#include <vector>

#include "mimic_groups.hpp"
#include "plugins/motion/common/multibody/robot_model.hpp"
#include "structure.hpp"

namespace muro::articulated {

struct Model {
  std::vector<Body> bodies;
  std::vector<Joint> joints;  ///< one per body, that of the base unused
  MimicGroups mimics;
  int slots = 0;
  bool fixed = false;

  Structure structure() const;
  bool operator==(const Model&) const = default;
};

/// Bodies have frames that are parallel to those of their parents where the axis of the joint is one of theirs, and
/// else have the axis of the joint as one of their own. What joints follow is not set. [setup]
Model model_of_bodies(const multibody::RobotModel& robot);
/// Of all bodies, in the frames that the model gives them. [setup]
std::vector<Mass> masses_of_bodies(const multibody::RobotModel& robot);
/// m: of the whole robot as it starts. [setup]
double radius_of_gyration(const multibody::RobotModel& robot);

}  // namespace muro::articulated
