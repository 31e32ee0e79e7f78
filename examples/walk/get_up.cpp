// SPDX-License-Identifier: MIT
#include "get_up.hpp"

#include <algorithm>
#include <iterator>

namespace walking {
namespace {

constexpr double along = 0.08;  // arms do not touch the trunk

constexpr KeyPose from_belly[] = {
    {0.30, 1.000, 0.00, 0.00, 0.00, 1},       {0.50, 1.000, 0.00, 0.00, -2.70, 1},
    {0.30, 1.000, 0.00, 0.00, -2.70, along},  {0.31, 0.536, 0.84, 0.66, -2.38, along},
    {0.58, 0.454, 0.07, 0.65, -2.49, along},  {0.20, 0.476, -0.58, -0.85, -0.44, along},
    {0.86, 0.462, -0.56, -0.32, 0.08, along},
};
constexpr KeyPose from_back[] = {
    {0.30, 1.000, 0.00, 0.00, 0.00, 1},      {0.50, 1.000, 0.00, 0.00, 2.80, 1},
    {0.30, 1.000, 0.00, 0.00, 2.80, along},  {1.34, 0.968, -1.31, -2.36, 1.07, along},
    {1.21, 0.671, -0.82, 1.22, 1.31, along}, {0.55, 0.622, -0.75, -0.06, 2.04, along},
    {0.28, 0.454, 0.67, 1.22, 2.45, along},  {0.88, 0.454, 0.61, 0.36, -0.38, along},
};

constexpr double sideways = 1.5707963267948966;  // rad, of shoulder roll from along the trunk

}  // namespace

GetUp::GetUp(const Settings& s) : thigh_(s.body.leg.thigh), shin_(s.body.leg.shin) {}

std::span<const KeyPose> GetUp::poses_of(const Progress& progress) {
  return progress.on_back ? std::span<const KeyPose>(from_back) : std::span<const KeyPose>(from_belly);
}

void GetUp::advance(Progress& progress, double h) const {
  const auto poses = poses_of(progress);
  progress.time += h;
  if (is_done(progress) || progress.time < poses[std::size_t(progress.pose)].duration) return;
  progress.time = 0;
  ++progress.pose;
}

Posture GetUp::straight() const { return posture_of({0, 1, 0, 0, 0, along}); }

/// The knee is ahead of the line from hip to ankle.
Posture GetUp::posture_of(const KeyPose& pose) const {
  const double d = pose.ankle_distance * (thigh_ + shin_);
  const double bend =
      muro_acos(std::clamp((d * d - thigh_ * thigh_ - shin_ * shin_) / (2 * thigh_ * shin_), -1.0, 1.0));
  const double hip = pose.ankle_way - muro_atan2(shin_ * muro_sin(bend), thigh_ + shin_ * muro_cos(bend));
  Posture all;
  all.legs[left_side] = {0, 0, hip, bend, pose.sole_pitch - hip - bend, 0};
  all.legs[right_side] = all.legs[left_side];
  all.arm = {pose.arm_pitch, sideways * (pose.arm_spread - 1), 0};
  return all;
}

Posture GetUp::posture(const Progress& progress) const {
  const auto poses = poses_of(progress);
  if (is_done(progress)) return posture_of(poses.back());
  const KeyPose& next = poses[std::size_t(progress.pose)];
  const Posture from = progress.pose == 0 ? straight() : posture_of(poses[std::size_t(progress.pose) - 1]);
  const Posture to = posture_of(next);
  const double part = std::min(1.0, progress.time / next.duration), done = part * part * (3 - 2 * part);
  Posture now;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t j = 0; j < leg_joints; ++j)
      now.legs[side][j] = from.legs[side][j] + done * (to.legs[side][j] - from.legs[side][j]);
  for (std::size_t j = 0; j < now.arm.size(); ++j) now.arm[j] = from.arm[j] + done * (to.arm[j] - from.arm[j]);
  return now;
}

}  // namespace walking
