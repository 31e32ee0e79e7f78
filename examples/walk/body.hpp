// SPDX-License-Identifier: MIT
// The robot's body as a walk needs it: two legs, a trunk with all the rest, and the places of their masses.
#pragma once

#include <array>

#include "leg.hpp"
#include "reference.hpp"

namespace walking {

struct BodyDimensions {
  LegDimensions leg;
  Vector upper_com;       ///< m: centre of mass of all but the legs, in the frame of the trunk
  double mass = 1;        ///< kg, mass of the robot
  double leg_mass = 0.2;  ///< share of each leg in the mass
  double leg_com = 0.5;   ///< place of the mass of a leg, from hip (0) to sole (1)
  double stiffness = 0;   ///< N m/rad, of the legs' position drives; 0: they do not give way
};

using BothLegs = std::array<LegAngles, 2>;  ///< left, right

class Body {
 public:
  explicit Body(const BodyDimensions& dimensions)
      : d_(dimensions), legs_{Leg(dimensions.leg, 1), Leg(dimensions.leg, -1)} {}

  const Leg& leg(Side side) const { return legs_[side]; }
  /// Returns the height of the centre of mass, m above the soles, standing with the trunk's origin at `trunk_height`.
  double com_height(double trunk_height) const;
  /// Returns the centre of mass of the whole robot in the frame of the trunk, for these places of both soles in it.
  Vector com(const Vector& left_sole, const Vector& right_sole) const;
  /// Returns the pose of the trunk for the wanted places of soles and centre of mass, `lean` rad nose down.
  Frame trunk_for(const Reference& now, double trunk_height, double lean) const;
  BothLegs legs_for(const Reference& now, const Frame& trunk) const;
  /// Returns by how much targets lead the angles so that springs carry the weight: effort / stiffness for each joint.
  /// Efforts come from the force of the ground, which acts from the ZMP through the centre of mass, and from the legs'
  /// own weight.
  BothLegs sag(const Reference& now, const Frame& trunk, const BothLegs& angles) const;

 private:
  double trunk_share() const { return 1 - 2 * d_.leg_mass; }
  /// Returns the part of the centre of mass that moves with the trunk, in its frame.
  Vector fixed_part() const;

  BodyDimensions d_;
  std::array<Leg, 2> legs_;
};

}  // namespace walking
