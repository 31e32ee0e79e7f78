// SPDX-License-Identifier: MIT
#include "body.hpp"

#include <algorithm>

namespace walking {

Vector Body::fixed_part() const {
  const Vector hips{d_.leg.hip.x, 0, d_.leg.hip.z};
  return trunk_share() * d_.upper_com + (2 * d_.leg_mass * (1 - d_.leg_com)) * hips;
}

double Body::com_height(double trunk_height) const {
  return trunk_height * (1 - 2 * d_.leg_mass * d_.leg_com) + fixed_part().z;
}

Vector Body::com(const Vector& left_sole, const Vector& right_sole) const {
  return fixed_part() + (d_.leg_mass * d_.leg_com) * (left_sole + right_sole);
}

Frame Body::trunk_for(const Reference& now, double trunk_height, double lean) const {
  const Rotation rotation = about_z(now.yaw) * about_y(lean);
  const Vector fixed = rotation * fixed_part();
  const Foothold left = now.soles[left_side].at, right = now.soles[right_side].at;
  const double with_soles = d_.leg_mass * d_.leg_com, with_trunk = 1 - 2 * with_soles;
  return {rotation,
          {(now.x.position - fixed.x - with_soles * (left.x + right.x)) / with_trunk,
           (now.y.position - fixed.y - with_soles * (left.y + right.y)) / with_trunk, trunk_height}};
}

BothLegs Body::legs_for(const Reference& now, const Frame& trunk) const {
  BothLegs angles;
  for (const Side side : {left_side, right_side}) {
    const SolePlace& sole = now.soles[side];
    angles[side] =
        legs_[side].angles_for(trunk.inverse() * Frame{about_z(sole.at.yaw), {sole.at.x, sole.at.y, sole.height}});
  }
  return angles;
}

BothLegs Body::sag(const Reference& now, const Frame& trunk, const BothLegs& angles) const {
  BothLegs lead{};
  if (d_.stiffness <= 0) return lead;
  const Rotation to_trunk = trunk.rotation.inverse();
  const Vector accelerated{now.acceleration_x, now.acceleration_y, gravity};
  const Vector weight = to_trunk * Vector{0, 0, -gravity * d_.mass * d_.leg_mass};
  for (const Side side : {left_side, right_side}) {
    const double carried = d_.mass * (side == left_side ? now.left_share : 1 - now.left_share);
    const Vector force = carried * (to_trunk * accelerated);
    const Vector sole = legs_[side].sole_at(angles[side]).origin;
    const auto axes = legs_[side].axes_at(angles[side]);
    const Vector mass_at = (1 - d_.leg_com) * axes[hip_yaw].origin + d_.leg_com * sole;
    for (std::size_t j = 0; j < leg_joints; ++j) {
      Vector moment = cross(sole - axes[j].origin, force);
      if (j <= hip_pitch) moment = moment + cross(mass_at - axes[j].origin, weight);
      lead[side][j] = -dot(axes[j].axis, moment) / d_.stiffness;
    }
  }
  return lead;
}

}  // namespace walking
