// SPDX-License-Identifier: MIT
#include "stance.hpp"

namespace muro::biped {

namespace {

constexpr int most_changes = 8;     ///< largest number of changes of the stance foot in a step
constexpr double accuracy = 1e-13;  ///< m: accuracy of the height at which the sole touches
constexpr int most_iterations = 80;
constexpr double least_interval = 1e-15;  ///< part of a step

}  // namespace

FootPoses Footing::feet_at(const LegPositions& q, double s) const {
  const auto position = [&](std::uint32_t i) { return q.at(i, s); };
  return {{feet_.legs[0].foot(position), feet_.legs[1].foot(position)}};
}

double Footing::height(std::uint32_t i, const Pose& foot) const {
  return feet_.soles[i].lowest(foot.orientation.conjugate() * plane_.normal) + plane_.height(foot.position);
}

/// Returns `foot` shifted along the normal until its lowest point touches.
Pose Footing::touching(std::uint32_t i, Pose foot) const {
  foot.position -= height(i, foot) * plane_.normal;
  return foot;
}

/// Returns `foot` turned about its lowest point by the smallest turn that lays the sole on the plane.
Pose Footing::flush(std::uint32_t i, const Pose& foot) const {
  const Sole& sole = feet_.soles[i];
  const Vec3 pivot = foot * sole.lowest_point(foot.orientation.conjugate() * plane_.normal);
  const Quat turn = sole.flush_turn(foot.orientation, plane_.normal);
  Pose flat;
  flat.orientation = (turn * foot.orientation).normalized();
  flat.position = pivot + turn * Vec3(foot.position - pivot);
  return touching(i, flat);
}

bool Footing::leaves_room(std::uint32_t i, const Pose& foot, const Pose& other) const {
  return height(1 - i, foot * other) >= -hysteresis_;
}

void Footing::put_down(std::uint32_t i, Pose foot, const FootPoses& feet, Stance& stance) const {
  foot.orientation.normalize();
  const Pose flat = flush(i, foot);
  stance.foot = i;
  stance.is_flush = leaves_room(i, flat, feet.other(i));
  stance.pose = stance.is_flush ? flat : touching(i, foot);
  ++stance.footholds;
}

/// Lays a tilted stance foot flat, if the other foot leaves room.
void Footing::lie_down_flat(const FootPoses& feet, Stance& stance) const {
  const Pose flat = flush(stance.foot, stance.pose);
  if (!leaves_room(stance.foot, flat, feet.other(stance.foot))) return;
  stance.pose = flat;
  stance.is_flush = true;
  ++stance.footholds;
}

/// Returns the part of the step at which the sole of the swing foot touches the plane, by the rule of false position
/// with halved ordinates (the Illinois algorithm; Dowell and Jarratt, BIT 11, 1971). `last_height` (m, below 0): height
/// at the end.
double Footing::crossing(const LegPositions& q, const Stance& stance, double from, double last_height) const {
  const auto height_at = [&](double s) {
    return height(1 - stance.foot, stance.pose * feet_at(q, s).other(stance.foot));
  };
  double low = from, high = 1, at_low = height_at(from), at_high = last_height;
  if (at_low <= 0) return from;
  double s = high;
  int kept = 0;  // below 0: the lower end was kept last time, above 0: the upper end
  for (int i = 0; i < most_iterations && high - low > least_interval; ++i) {
    s = (low * at_high - high * at_low) / (at_high - at_low);
    const double now = height_at(s);
    if (std::abs(now) <= accuracy) break;
    if (now > 0) {
      low = s, at_low = now;
      if (kept > 0) at_high *= 0.5;
      kept = 1;
    } else {
      high = s, at_high = now;
      if (kept < 0) at_low *= 0.5;
      kept = -1;
    }
  }
  return s;
}

double Footing::walk(const LegPositions& q, const FootPoses& end, Stance& stance) const {
  double last = -1, swing_height = 0;
  for (int changes = 0;; ++changes) {
    const std::uint32_t swing = 1 - stance.foot;
    const Pose swing_at_end = stance.pose * end.other(stance.foot);
    swing_height = height(swing, swing_at_end);
    if (swing_height >= -hysteresis_) break;
    const double s = crossing(q, stance, std::max(last, 0.0), swing_height);
    if (s == last || changes == most_changes) {  // both feet press into the plane: the robot is lifted
      put_down(swing, swing_at_end, end, stance);
      swing_height = height(1 - stance.foot, stance.pose * end.other(stance.foot));
      break;
    }
    const FootPoses feet = feet_at(q, s);
    put_down(swing, stance.pose * feet.other(stance.foot), feet, stance);
    last = s;
  }
  if (stance.is_flush) return swing_height;
  lie_down_flat(end, stance);
  return height(1 - stance.foot, stance.pose * end.other(stance.foot));
}

Stance Footing::stand_up(const Pose& base, const FootPoses& feet, const Stance& before) const {
  const std::array<Pose, 2> at{base * feet.foot[0], base * feet.foot[1]};
  const std::array<double, 2> heights{height(0, at[0]), height(1, at[1])};
  const std::uint32_t kept = before.foot, other = 1 - kept;
  const std::uint32_t lower = heights[other] < heights[kept] - hysteresis_ ? other : kept;
  Stance stance = before;
  for (const std::uint32_t i : {lower, 1 - lower}) {
    const Pose flat = flush(i, at[i]);
    if (!leaves_room(i, flat, feet.other(i))) continue;
    stance.foot = i, stance.pose = flat, stance.is_flush = true;
    ++stance.footholds;
    return stance;
  }
  return stand_on_edges(base, feet, before);
}

/// Returns a stance in which neither sole lies flat, since the other foot would be below the plane. The mean of their
/// normals points down, and the robot stands on the lowest point of the soles.
Stance Footing::stand_on_edges(const Pose& base, const FootPoses& feet, const Stance& before) const {
  const auto down = [&](std::uint32_t i) {
    return Vec3((base.orientation * feet.foot[i].orientation) * feet_.soles[i].normal());
  };
  const Vec3 mean = down(0) + down(1);
  const Vec3 direction = mean.norm() > 1e-6 ? Vec3(mean.normalized()) : down(before.foot);
  const Quat turn = turn_between(direction, -plane_.normal);
  const Pose turned{base.position, (turn * base.orientation).normalized()};
  const std::array<Pose, 2> at{turned * feet.foot[0], turned * feet.foot[1]};
  const std::uint32_t kept = before.foot, other = 1 - kept;
  Stance stance = before;
  stance.foot = height(other, at[other]) < height(kept, at[kept]) - hysteresis_ ? other : kept;
  stance.pose = touching(stance.foot, at[stance.foot]);
  stance.is_flush = false;
  ++stance.footholds;
  return stance;
}

}  // namespace muro::biped
