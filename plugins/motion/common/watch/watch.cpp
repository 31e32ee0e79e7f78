// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "muro/vocabulary.hpp"
#include "parameters.hpp"

namespace muro::watch {

namespace {

constexpr double least_speed = 100;     ///< m/s: smallest speed limit when none is given
constexpr double pushed_speed = 1e4;    ///< m/s: smallest speed limit of robots that something pushes
constexpr double least_depth = 0.1;     ///< m: smallest depth limit when none is given
constexpr double speed_factor = 2;      ///< times the speed that drives and start explain
constexpr double overlap_factor = 1.5;  ///< times the overlap at the start

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

}  // namespace

std::string how_to_go_on(std::string_view parameter) {
  return "; if it is meant to be so, raise `" + std::string(parameter) + "` of its motion, or set `watch: off`";
}

Watch::Watch(const Connector& c, const Parameters& p, const Reach& reach) {
  gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
  base_reach_square_ = reach.of_link[0] * reach.of_link[0];
  if (p.text(watch.name) == "off") return;
  speed_is_given_ = p.real(watch_speed.name) > 0;
  const double toppling = speed_factor * std::sqrt(4 * gravity_.norm() * reach.of_link[0]);
  if (speed_is_given_) gravity_.setZero();  // however far it falls
  depth_is_given_ = p.real(watch_depth.name) > 0;
  own_speed_ =
      speed_is_given_ ? p.real(watch_speed.name) : std::max(least_speed, speed_factor * reach.drive_speed) + toppling;
  depth_ = depth_is_given_ ? p.real(watch_depth.name) : std::max(least_depth, reach.of_link[0]);
}

void Watch::allow_pushes() {
  if (own_speed_ > 0 && !speed_is_given_) own_speed_ = std::max(own_speed_, pushed_speed);
}

void Watch::begin(const Vec3& position, const Twist& twist) {
  start_ = gravity_.dot(position);
  if (own_speed_ == 0) return;
  const double now = twist.linear.norm() + twist.angular.norm() * std::sqrt(base_reach_square_);
  const double speed = own_speed_ + (std::isfinite(now) && !speed_is_given_ ? speed_factor * now : 0);
  speed_square_ = speed * speed;
}

void Watch::begin_overlap(double depth) {
  if (own_speed_ > 0 && !depth_is_given_) depth_ = std::max(depth_, overlap_factor * depth);
}

std::string Watch::speed_text(const Vec3& position, const Twist& twist) const {
  const double speed = twist.linear.norm(), edge = twist.angular.norm() * std::sqrt(base_reach_square_);
  if (!(position.squaredNorm() < beyond * beyond) || !(speed < beyond) || !(edge < beyond))
    return "the motion of its base is no longer finite";
  if (edge > speed)
    return speed_text(position, "its base turns at " + text(twist.angular.norm()) + " rad/s: its edge moves", edge);
  return speed_text(position, "its base moves", speed);
}

std::string Watch::speed_text(const Vec3& position, const std::string& what, double speed) const {
  if (!(speed < beyond)) return what + " at a speed that is no longer finite";
  const std::string limit = text(std::sqrt(allowed_square(position)));
  return what + " at " + text(speed) + " m/s, beyond the " + limit +
         (speed_is_given_ ? " m/s of its `watch_speed`" : " m/s that its drives, start and fall explain");
}

std::string Watch::depth_text(const std::string& what, const std::string& obstacle, double depth) const {
  return what + " is " + text(depth) + " m deep in " + obstacle + ", beyond the " + text(depth_) +
         (depth_is_given_ ? " m of its `watch_depth`" : " m of its size");
}

}  // namespace muro::watch
