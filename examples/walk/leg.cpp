// SPDX-License-Identifier: MIT
#include "leg.hpp"

#include <algorithm>

#include "../common/two_bones.hpp"

namespace walking {
namespace {

/// A bone between the axes at its upper and its lower end, seen along y: length, and the pitch at which it hangs.
struct Bone {
  double length, pitch;
};

Bone bone_of(double ahead, double down) { return {std::sqrt(ahead * ahead + down * down), muro_atan2(-ahead, down)}; }

double arc_sine(double x) { return muro_asin(std::clamp(x, -1.0, 1.0)); }

}  // namespace

double Leg::length() const { return bone_of(d_.knee_x, d_.thigh).length + bone_of(d_.ankle_x, d_.shin).length; }

std::array<Frame, leg_joints> Leg::links_at(const LegAngles& q) const {
  return {{{about_z(q[hip_yaw]), mirrored(d_.hip)},
           {about_x(q[hip_roll]), {}},
           {about_y(q[hip_pitch]), {d_.hip_pitch_x, side_ * d_.leg_y, d_.hip_pitch_z}},
           {about_y(q[knee]), {d_.knee_x, 0, -d_.thigh}},
           {about_y(q[ankle_pitch]), {d_.ankle_x, 0, -d_.shin}},
           {about_x(q[ankle_roll]), {0, 0, -d_.ankle_z}}}};
}

Frame Leg::sole_at(const LegAngles& q) const {
  Frame at;
  for (const Frame& link : links_at(q)) at = at * link;
  return at * Frame{{}, {d_.sole_x, side_ * d_.sole_y, -d_.sole_z}};
}

std::array<JointAxis, leg_joints> Leg::axes_at(const LegAngles& q) const {
  constexpr std::array<Vector, leg_joints> axes{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}}};
  const std::array<Frame, leg_joints> links = links_at(q);
  std::array<JointAxis, leg_joints> all;
  Frame at;
  for (std::size_t j = 0; j < leg_joints; ++j) {
    at = at * links[j];
    all[j] = {at.origin, at.rotation * axes[j]};
  }
  return all;
}

LegAngles Leg::angles_for(const Frame& sole) const {
  LegAngles q;
  const Vector hip = mirrored(d_.hip);
  const Vector roll_axis = sole.origin - sole.rotation * Vector{d_.sole_x, side_ * d_.sole_y, -d_.sole_z};
  // Only ankle roll moves the hip across the pitch axes, which are all parallel: the hip is leg_y inwards of them.
  const Vector up = sole.rotation.inverse() * (hip - roll_axis);
  const double across = std::sqrt(up.y * up.y + up.z * up.z);
  q[ankle_roll] = muro_atan2(up.y, up.z) + arc_sine(side_ * d_.leg_y / std::max(across, 1e-9));
  // The remaining rotation of the foot is yaw, roll, and the sum of the three pitches.
  const Rotation ankle = sole.rotation * about_x(-q[ankle_roll]);
  q[hip_roll] = arc_sine(ankle.y.z);
  q[hip_yaw] = muro_atan2(-ankle.y.x, ankle.y.y);
  const double pitch = muro_atan2(-ankle.x.z, ankle.z.z);
  // Hip and knee are the joints of an arm of two bones in the plane of the leg.
  const Rotation roll = about_z(q[hip_yaw]) * about_x(q[hip_roll]);
  const Vector hip_at = hip + roll * Vector{d_.hip_pitch_x, side_ * d_.leg_y, d_.hip_pitch_z};
  const Vector down = roll.inverse() * (roll_axis + ankle * Vector{0, 0, d_.ankle_z} - hip_at);
  const Bone thigh = bone_of(d_.knee_x, d_.thigh), shin = bone_of(d_.ankle_x, d_.shin);
  const examples::TwoBones bones{thigh.length, shin.length};
  const double bend = bones.bend_for(down.x * down.x + down.z * down.z);
  const double first = muro_atan2(-down.x, -down.z) - bones.lead(bend);
  q[hip_pitch] = first - thigh.pitch;
  q[knee] = bend - shin.pitch + thigh.pitch;
  q[ankle_pitch] = pitch - q[hip_pitch] - q[knee];
  return q;
}

}  // namespace walking
