// SPDX-License-Identifier: MIT
// The robot's body as far as it matters for walking: two legs, a trunk with all the rest, and where their masses are.
#pragma once

#include <array>

#include "leg.hpp"
#include "reference.hpp"

namespace walking {

struct BodyDimensions {
  LegDimensions leg;
  Vector upper_com;       ///< m: of all but the legs, in the frame of the trunk
  double mass = 1;        ///< kg, of the robot
  double leg_mass = 0.2;  ///< share of a leg in it
  double leg_com = 0.5;   ///< where a leg has its mass, between hip (0) and sole (1)
  double stiffness = 0;   ///< N m/rad, of the legs' position drives; 0: they do not give way
};

using BothLegs = std::array<LegAngles, 2>;  ///< left, right

class Body {
 public:
  explicit Body(const BodyDimensions& dimensions)
      : d_(dimensions), legs_{Leg(dimensions.leg, 1), Leg(dimensions.leg, -1)} {}

  const Leg& leg(Side side) const { return legs_[side]; }
  /// m above the soles, standing with the trunk's origin at `trunk_height`.
  double com_height(double trunk_height) const;
  /// Of the whole robot, in the frame of the trunk, by the places of both soles in it.
  Vector com(const Vector& left_sole, const Vector& right_sole) const;
  /// The trunk so that soles and centre of mass are where they are to be, `lean` rad nose down.
  Frame trunk_for(const Reference& now, double trunk_height, double lean) const;
  BothLegs legs_for(const Reference& now, const Frame& trunk) const;
  /// How far targets lead the angles so that springs carry the weight: each by its effort / stiffness. Efforts are
  /// those of the force from the ground, which goes from the ZMP through the centre of mass, and of the legs' own
  /// weight.
  BothLegs sag(const Reference& now, const Frame& trunk, const BothLegs& angles) const;

 private:
  double trunk_share() const { return 1 - 2 * d_.leg_mass; }
  /// What of the centre of mass goes with the trunk, in its frame.
  Vector fixed_part() const;

  BodyDimensions d_;
  std::array<Leg, 2> legs_;
};

}  // namespace walking
