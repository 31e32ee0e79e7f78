// SPDX-License-Identifier: MIT
// The two feet of a robot: their legs and their soles.
#pragma once

#include <array>

#include "leg.hpp"
#include "muro/algorithm.hpp"
#include "sole.hpp"

namespace muro::biped {

/// What robots of one model share.
struct Feet {
  std::array<Leg, 2> legs;
  std::array<Sole, 2> soles;  ///< in the frames of the links of the feet
  bool operator==(const Feet&) const = default;
};

/// Feet of one robot, with what they are in it.
struct FeetOfRobot {
  Feet feet;
  std::array<std::uint32_t, 2> links{};  ///< of the feet
  std::vector<std::uint32_t> joints;     ///< links to which the joints of both legs lead, by LegJoint::number
  std::vector<bool> is_of_foot;          ///< for every link, whether it belongs to the rigid body of a foot
};

/// The feet that the parameter `feet` names, with soles from their collision shapes, and `sole_normal`, where it is
/// given. Throws Error for what is no pair of feet. [setup]
FeetOfRobot find_feet(const Connector& c, const RobotView& robot);

}  // namespace muro::biped
