// SPDX-License-Identifier: MIT
#include "balance.hpp"

#include <algorithm>
#include <cmath>

namespace walking {
namespace {

/// Returns the part of `x` that exceeds the tolerance.
double beyond(double x, double tolerance) { return x - std::clamp(x, -tolerance, tolerance); }

}  // namespace

double Balance::astray(const Reference& now, double w, const Body& body, const Attitude& attitude,
                       const std::array<Frame, 2>& soles, const BalanceSettings& b, double h) {
  const Side stance = now.stance;
  // the stance foot, or the middle of both feet: on the ground as planned, and in the trunk's frame by the joints
  Foothold ground = now.soles[stance].at;
  Vector foot = soles[stance].origin;
  if (now.both) {
    const Foothold& o = now.soles[other(stance)].at;
    ground = {0.5 * (ground.x + o.x), 0.5 * (ground.y + o.y), ground.yaw};
    foot = 0.5 * (foot + soles[other(stance)].origin);
  }
  const Vector com = body.com(soles[left_side].origin, soles[right_side].origin);
  const Vector from_foot = attitude.tilt() * (com - foot);
  past_[seen_ % room] = {now.x.position, now.y.position};
  const std::int64_t back = std::clamp<std::int64_t>(std::lround(b.delay / h), 0, std::min(seen_, room - 1));
  const auto& planned = past_[(seen_ - back) % room];
  double s, c;
  muro_sincos(now.yaw, &s, &c);
  const double off = from_foot.x - (c * (planned[0] - ground.x) + s * (planned[1] - ground.y));
  const std::int64_t on = now.both ? -1 : std::int64_t(stance);
  // a foot that begins to carry is not where it was planned: this difference is no speed
  if (seen_ > 0 && on == stance_) drift_ += h / (b.smoothing + h) * ((off - off_) / h - drift_);
  off_ = off;
  stance_ = on;
  ++seen_;
  return seen_ < room ? 0 : beyond(off_ + drift_ / w, b.tolerance);
}

void keep_balance(BothLegs& angles, const Reference& now, const Attitude& attitude, double lean,
                  const BalanceSettings& b, double springs) {
  const double pitch = attitude.pitch() - lean, roll = attitude.roll();
  const auto add = [&](LegAngles& q, int joint, const Gains& k, double tilt, double rate) {
    q[joint] += springs * (k.tilt * tilt + k.rate * rate);
  };
  for (const Side side : {left_side, right_side}) {
    if (!now.carries(side)) continue;
    add(angles[side], ankle_pitch, b.ankle_pitch, pitch, attitude.rate().y);
    add(angles[side], ankle_roll, b.ankle_roll, roll, attitude.rate().x);
    add(angles[side], hip_pitch, b.hip_pitch, pitch, attitude.rate().y);
    add(angles[side], hip_roll, b.hip_roll, roll, attitude.rate().x);
  }
}

}  // namespace walking
