// SPDX-License-Identifier: MIT
// Rule for which links of one robot can touch each other. It is used by motions that collide links of a robot
// (`self_collision`), and by collision algorithms that find such contacts for them.
#pragma once

#include <cstdint>
#include <vector>

#include "muro/robot.hpp"

namespace muro::contact_geometry {

/// Rigid bodies of a robot: links that fixed joints hold together are one body.
class LinkBodies {
 public:
  explicit LinkBodies(const RobotView& robot) {
    for (const Link& link : robot.links) {
      const bool is_base = of_link_.empty();
      if (!is_base && link.joint == JointKind::fixed) {
        of_link_.push_back(of_link_[std::size_t(link.parent)]);
        continue;
      }
      of_link_.push_back(std::uint32_t(parents_.size()));
      parents_.push_back(is_base ? -1 : std::int32_t(of_link_[std::size_t(link.parent)]));
    }
  }
  /// Whether links `a` and `b` of the robot may touch: not links of one body, and not those of bodies that a joint
  /// connects.
  bool may_touch(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t first = of_link_[a], second = of_link_[b];
    return first != second && parents_[first] != std::int32_t(second) && parents_[second] != std::int32_t(first);
  }

 private:
  std::vector<std::uint32_t> of_link_;
  std::vector<std::int32_t> parents_;  ///< by body; -1: the base
};

}  // namespace muro::contact_geometry
