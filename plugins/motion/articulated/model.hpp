// SPDX-License-Identifier: MIT
// Rigid bodies of a robot in the form of the kernel: the structure that robots moved together share, and their masses.
#pragma once

#include <vector>

#include "mimic_groups.hpp"
#include "plugins/motion/common/multibody/robot_model.hpp"
#include "structure.hpp"

namespace muro::articulated {

struct Model {
  std::vector<Body> bodies;
  std::vector<Joint> joints;  ///< one per body; that of the base is unused
  MimicGroups mimics;
  int slots = 0;
  bool fixed = false;

  Structure structure() const;
  bool operator==(const Model&) const = default;
};

/// Returns the bodies of a robot. Their frames are parallel to those of their parents if the axis of the joint is an
/// axis of these; else the axis of the joint is an axis of their own. The drives of joints are not set. [setup]
Model model_of_bodies(const multibody::RobotModel& robot);
/// Returns the masses of all bodies, in the frames that the model gives them. [setup]
std::vector<Mass> masses_of_bodies(const multibody::RobotModel& robot);
/// Returns the radius of gyration of the whole robot as it starts (m). [setup]
double radius_of_gyration(const multibody::RobotModel& robot);

}  // namespace muro::articulated
