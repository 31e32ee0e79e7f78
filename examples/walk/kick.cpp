// SPDX-License-Identifier: MIT
#include "kick.hpp"

#include <cmath>

namespace walking {
namespace {

/// Motion along one axis: m, m/s, m/s^2.
struct Motion {
  double position, velocity, acceleration;
};

/// Returns the motion `t` s after its beginning, from `a` and its velocity to rest at `to` in `duration` s: the
/// polynomial of fifth degree that begins and ends without acceleration.
Motion come_to_rest(const Pendulum& a, double to, double duration, double t) {
  const double T = duration, s = std::clamp(t / T, 0.0, 1.0), way = to - a.position, v = a.velocity * T;
  const double s2 = s * s, s3 = s2 * s;
  return {a.position + v * s + s3 * (10 * way - 6 * v + s * (8 * v - 15 * way + s * (6 * way - 3 * v))),
          (v + s2 * (30 * way - 18 * v + s * (32 * v - 60 * way + s * (30 * way - 15 * v)))) / T,
          s * (60 * way - 36 * v + s * (96 * v - 180 * way + s * (120 * way - 60 * v))) / (T * T)};
}

}  // namespace

void Kick::begin(const Reference& from, Side foot, double speed, const KickSettings& k) {
  *this = {};
  begun_ = 1;
  from_ = from;
  foot_ = foot;
  constexpr double peak = 1.875;  // greatest slope of smooth()
  forward_ = peak * (k.back + k.forward) / std::fmax(speed, slowest);
}

void Kick::place_com(Reference& now, const KickSettings& k) const {
  const Foothold &l = from_.soles[left_side].at, &r = from_.soles[right_side].at;
  const Foothold middle{0.5 * (l.x + r.x), 0.5 * (l.y + r.y), from_.yaw};
  const Foothold over = from_.soles[other(foot_)].at.beside(0, foot_ == left_side ? -k.outward : k.outward);
  const bool goes_back = time_ > shift_back_at(k);
  const double t = goes_back ? time_ - shift_back_at(k) : time_;
  const Motion x =
      goes_back ? come_to_rest({over.x, 0}, middle.x, k.shift, t) : come_to_rest(from_.x, over.x, k.shift, t);
  const Motion y =
      goes_back ? come_to_rest({over.y, 0}, middle.y, k.shift, t) : come_to_rest(from_.y, over.y, k.shift, t);
  now.x = {x.position, x.velocity}, now.y = {y.position, y.velocity};
  now.acceleration_x = x.acceleration, now.acceleration_y = y.acceleration;
}

SolePlace Kick::swing_sole(const KickSettings& k) const {
  const double t = time_ - k.shift;
  const double back = std::clamp(t / k.swing, 0.0, 1.0);
  const double forward = std::clamp((time_ - forward_at(k)) / forward_, 0.0, 1.0);
  const double down = std::clamp((time_ - return_at(k)) / k.swing, 0.0, 1.0);
  const double ahead = -k.back * smooth(back) + (k.back + k.forward) * smooth(forward) - k.forward * smooth(down);
  // the foot rises before it goes back, and is put down when it has come back
  const double height = smooth(std::min(1.0, 2 * back)) * smooth(std::min(1.0, 2 - 2 * down));
  return {from_.soles[foot_].at.beside(ahead, 0), k.rise * height};
}

Reference Kick::reference(const KickSettings& k) const {
  Reference now = from_;
  place_com(now, k);
  now.stance = other(foot_);
  now.both = time_ <= k.shift || time_ >= shift_back_at(k);
  now.soles[foot_] = swing_sole(k);
  const double w2 = gravity / k.com_height;
  now.left_share = share_of_left(now.x.position - now.acceleration_x / w2, now.y.position - now.acceleration_y / w2,
                                 from_.soles[left_side].at, from_.soles[right_side].at);
  if (!now.both) now.left_share = now.stance == left_side ? 1 : 0;
  return now;
}

}  // namespace walking
