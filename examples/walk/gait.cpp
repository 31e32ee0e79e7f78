// SPDX-License-Identifier: MIT
#include "gait.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace walking {
namespace {

double bounded(double x, double most) { return std::clamp(x, -most, most); }

double sign_of(Side side) { return side == left_side ? 1 : -1; }

}  // namespace

double GaitSettings::w() const { return std::sqrt(gravity / com_height); }

void Gait::stand(const Foothold& at, const GaitSettings& g) {
  feet_ = {at.beside(0, 0.5 * g.foot_distance), at.beside(0, -0.5 * g.foot_distance)};
  target_ = feet_[left_side];
  speed_ = {};
  x_ = {at.x, 0}, y_ = {at.y, 0};
  zmp_x_ = at.x, zmp_y_ = at.y;
  yaw_ = yaw_before_ = at.yaw;
  time_ = 0;
  phase_ = standing;
  steps_in_place_ = 0;
}

Foothold Gait::middle() const {
  const Foothold &l = feet_[left_side], &r = feet_[right_side];
  return {0.5 * (l.x + r.x), 0.5 * (l.y + r.y), 0.5 * (l.yaw + r.yaw)};
}

/// Returns the step of this foot from the other one. To the side and around, the foot on that side goes twice as far
/// and the other one is put beside it, so that feet come no nearer to each other than when they stand.
Foothold Gait::stride(Side swing, const GaitSettings& g) const {
  const double s = sign_of(swing);
  return {g.period * speed_.forward, s * (g.foot_distance + 2 * g.period * std::max(0.0, s * speed_.left)),
          s * 2 * g.period * std::max(0.0, s * speed_.turn)};
}

void Gait::begin_step(const Velocity& command, const GaitSettings& g) {
  const Velocity wanted{bounded(command.forward, g.largest_step.forward / g.period),
                        bounded(command.left, 0.5 * g.largest_step.left / g.period),
                        bounded(command.turn, 0.5 * g.largest_step.turn / g.period)};
  speed_.forward += bounded(wanted.forward - speed_.forward, g.largest_change.forward / g.period);
  speed_.left += bounded(wanted.left - speed_.left, g.largest_change.left / g.period);
  speed_.turn += bounded(wanted.turn - speed_.turn, g.largest_change.turn / g.period);
  phase_ = stepping;
  time_ = 0;
  yaw_before_ = yaw_;
  zmp_x_ = feet_[stance_].x, zmp_y_ = feet_[stance_].y;
  steps_in_place_ = speed_.is_zero() ? steps_in_place_ + 1 : 0;
}

/// Sets the point about which the pendulum falls while both feet carry, so that its capture point reaches `xi` in time.
void Gait::begin_shift(Phase phase, double xi_x, double xi_y, const GaitSettings& g) {
  const double growth = muro_exp(g.w() * g.shift);
  zmp_x_ = (xi_x - x_.capture_point(g.w()) * growth) / (1 - growth);
  zmp_y_ = (xi_y - y_.capture_point(g.w()) * growth) / (1 - growth);
  phase_ = phase;
  time_ = 0;
  yaw_before_ = yaw_;
}

void Gait::end_step(const Velocity& command, const GaitSettings& g) {
  const Side swing = other(stance_);
  feet_[swing] = target_;
  x_.velocity = g.w() * (xi_.x - x_.position);
  y_.velocity = g.w() * (xi_.y - y_.position);
  astray_ = 0;
  stance_ = swing;
  yaw_ = middle().yaw;
  const bool stops = command.is_zero();
  if (!stops || steps_in_place_ < 2) return begin_step(command, g);
  begin_shift(shifting_out, middle().x, middle().y, g);
}

void Gait::place_swing_foot(const GaitSettings& g) {
  const Side swing = other(stance_);
  const Foothold& foot = feet_[stance_];
  const double w = g.w(), left = g.period - time_;
  const double xi_x = capture_point_after(x_.capture_point(w), left, foot.x, w);
  const double xi_y = capture_point_after(y_.capture_point(w), left, foot.y, w);
  const Foothold now = stride(swing, g), next = stride(stance_, g);
  const double ahead = capture_point_offset(next.x, now.x, g.period, w);
  const double beside = capture_point_offset(next.y, now.y, g.period, w);
  // in the axes of the stance foot
  double s, c;
  muro_sincos(foot.yaw, &s, &c);
  const double dx = xi_x - foot.x, dy = xi_y - foot.y;
  const double x = bounded(c * dx + s * dy + astray_ - ahead, g.largest_step.forward);
  const double out = sign_of(swing) * (-s * dx + c * dy - beside);
  const double nearest = g.foot_distance, farthest = g.foot_distance + g.largest_step.left;
  const double y = sign_of(swing) * std::clamp(out, nearest, farthest);
  target_ = foot.beside(x, y, now.yaw);
  xi_ = foot.beside(x + ahead, y + beside);
}

void Gait::advance(double h, const Velocity& command, const GaitSettings& g) {
  if (phase_ == standing) {
    if (command.is_zero()) return settle(h, g);
    stance_ = command.left < 0 || (command.left == 0 && command.turn < 0) ? left_side : right_side;
    const Foothold first = stride(other(stance_), g), second = stride(stance_, g);
    const Foothold xi = feet_[stance_].beside(capture_point_offset(first.x, second.x, g.period, g.w()),
                                              capture_point_offset(first.y, second.y, g.period, g.w()));
    begin_shift(shifting_in, xi.x, xi.y, g);
  }
  x_ = x_.after(h, zmp_x_, g.w());
  y_ = y_.after(h, zmp_y_, g.w());
  time_ += h;
  if (phase_ == stepping) place_swing_foot(g);
  const double end = phase_ == stepping ? g.period : g.shift;
  const double part = std::min(time_ / end, 1.0);
  const double yaw_after = phase_ == stepping ? 0.5 * (target_.yaw + feet_[stance_].yaw) : middle().yaw;
  yaw_ = yaw_before_ + smooth(part) * (yaw_after - yaw_before_);
  if (time_ < end - 0.5 * h) return;
  if (phase_ == stepping) return end_step(command, g);
  if (phase_ == shifting_in) return begin_step(command, g);
  phase_ = standing;
  speed_ = {};
  steps_in_place_ = 0;
}

/// Moves the centre of mass to the middle, where the capture point is.
void Gait::settle(double h, const GaitSettings& g) {
  const Foothold at = middle();
  const double w = g.w(), left = muro_exp(-w * h);
  zmp_x_ = at.x, zmp_y_ = at.y, yaw_ = at.yaw;
  x_.position = at.x + left * (x_.position - at.x), x_.velocity = w * (at.x - x_.position);
  y_.position = at.y + left * (y_.position - at.y), y_.velocity = w * (at.y - y_.position);
}

void Gait::find_astray(double ahead, const GaitSettings& g) {
  if (phase_ != stepping || swing_part(g) > 0.8) return;
  astray_ = ahead * muro_exp(g.w() * (g.period - time_));
}

double Gait::swing_part(const GaitSettings& g) const {
  const double both = 0.5 * g.double_support * g.period;
  return std::clamp((time_ - both) / (g.period - 2 * both), 0.0, 1.0);
}

double Gait::lift(const GaitSettings& g) const {
  if (phase_ != stepping) return 0;
  const double s = muro_sin(std::numbers::pi * swing_part(g));
  return s * s;
}

double Gait::share(const GaitSettings& g) const {
  if (phase_ != stepping) return share_of_left(zmp_x_, zmp_y_, feet_[left_side], feet_[right_side]);
  const double both = std::max(0.5 * g.double_support * g.period, 1e-9);
  const double carried = 0.5 + 0.5 * std::min({time_ / both, (g.period - time_) / both, 1.0});
  return stance_ == left_side ? carried : 1 - carried;
}

SolePlace Gait::sole(Side side, const GaitSettings& g) const {
  const Foothold& from = feet_[side];
  if (phase_ != stepping || side == stance_) return {from, 0};
  const double part = smooth(swing_part(g));
  return {{from.x + part * (target_.x - from.x), from.y + part * (target_.y - from.y),
           from.yaw + part * (target_.yaw - from.yaw)},
          g.rise * lift(g)};
}

Reference Gait::reference(const GaitSettings& g) const {
  const double w = g.w();
  return {.x = x_,
          .y = y_,
          .acceleration_x = w * w * (x_.position - zmp_x_),
          .acceleration_y = w * w * (y_.position - zmp_y_),
          .yaw = yaw_,
          .soles = {sole(left_side, g), sole(right_side, g)},
          .left_share = share(g),
          .stance = stance_,
          .both = phase_ != stepping};
}

}  // namespace walking
