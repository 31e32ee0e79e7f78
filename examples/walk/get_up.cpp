// SPDX-License-Identifier: MIT
#include "get_up.hpp"

#include <algorithm>
#include <iterator>

namespace walking {
namespace {

constexpr double along = 0.08;  // arms do not touch the trunk

constexpr KeyPose from_belly[] = {
    {0.30, 1.00, 0.00, 0.00, 0.00, 1.00},     {0.50, 1.00, 0.00, 0.00, -2.70, 1.00},
    {0.30, 1.00, 0.00, 0.00, -2.70, along},   {0.27, 0.55, 0.84, 0.56, -2.32, along},
    {0.58, 0.48, -0.08, 0.92, -2.61, along},  {0.20, 0.48, -0.65, -0.75, -0.37, along},
    {0.92, 0.44, -0.22, -0.35, -0.25, along},
};
constexpr KeyPose from_back[] = {
    {0.30, 1.00, 0.00, 0.00, 0.00, 1.00},   {0.50, 1.00, 0.00, 0.00, 2.80, 1.00},
    {0.30, 1.00, 0.00, 0.00, 2.80, along},  {1.35, 0.97, -1.46, -2.36, 1.20, along},
    {1.21, 0.70, -0.76, 1.22, 1.22, along}, {0.69, 0.62, -0.88, 0.01, 2.04, along},
    {0.28, 0.45, 0.85, 1.22, 2.45, along},  {0.87, 0.44, 0.66, 0.36, -0.38, along},
};

constexpr double sideways = 1.5707963267948966;  // rad, of shoulder roll from along the trunk

}  // namespace

GetUp::GetUp(const Settings& s) : bones_{s.body.leg.thigh, s.body.leg.shin} {}

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

/// Puts the knee ahead of the line from hip to ankle.
Posture GetUp::posture_of(const KeyPose& pose) const {
  const double d = pose.ankle_distance * (bones_.upper + bones_.lower);
  const double bend = bones_.bend_for(d * d);
  const double hip = pose.ankle_way - bones_.lead(bend);
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
