// SPDX-License-Identifier: MIT
// The two feet of a robot: its legs and its soles.
#pragma once

#include <array>

#include "leg.hpp"
#include "muro/algorithm.hpp"
#include "sole.hpp"

namespace muro::biped {

/// Data of the feet that robots of one model share.
struct Feet {
  std::array<Leg, 2> legs;
  std::array<Sole, 2> soles;  ///< soles in the frames of the links of the feet
  bool operator==(const Feet&) const = default;
};

/// Feet of one robot, and their places in it.
struct FeetOfRobot {
  Feet feet;
  std::array<std::uint32_t, 2> links{};  ///< links of the feet
  std::vector<std::uint32_t> joints;     ///< links to which the joints of both legs lead, by LegJoint::number
  std::vector<bool> is_of_foot;          ///< for every link, whether it belongs to the rigid body of a foot
};

/// Returns the feet that the parameter `feet` names. Soles are found from their collision shapes, and from
/// `sole_normal` if it is given. Throws Error if the names are not a pair of feet. [setup]
FeetOfRobot find_feet(const Connector& c, const RobotView& robot);

}  // namespace muro::biped
