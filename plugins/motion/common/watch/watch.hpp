// SPDX-License-Identifier: MIT
// Ends a run whose physics has come apart: forces that grow from step to step, or bodies that sink into the scenery,
// give numbers that look like results.
#pragma once

#include <string>

#include "reach.hpp"

namespace muro::watch {

/// m, m/s, rad/s: engines that diverge pass this on their way to infinity.
inline constexpr double beyond = 1e12;

/// Whether a body can be there and move like that: finite numbers, and an orientation that can be normalised.
inline bool is_somewhere(const Pose& pose, const Twist& twist) {
  const double norm = pose.orientation.squaredNorm();
  return pose.position.squaredNorm() < beyond * beyond && twist.linear.squaredNorm() < beyond * beyond &&
         twist.angular.squaredNorm() < beyond * beyond && norm > 0.25 && norm < 4;
}

/// The limits of one robot. It is no part of the state: it has no say in what a run does but for ending it.
class Watch {
 public:
  /// Sees nothing but that numbers are no longer those of bodies (beyond 1e12).
  Watch() = default;
  /// From the parameters of `parameters.hpp`, if they are on, and the robot's size, drives and start. [setup]
  Watch(const Connector& c, const Parameters& p, const Reach& reach);

  /// Something other than contacts and drives pushes the robot: only a far higher speed is a failure. [setup]
  void allow_pushes();
  /// The run begins, or goes on, from here: what it falls from here on, and what it has now, is no failure.
  void begin(const Vec3& position, const Twist& twist);
  /// Its deepest overlap (m) with scenery at the beginning: what starts deep in a wall has time to leave it.
  void begin_overlap(double depth);

  /// Whether a base may move like that; not when it is not finite. A body that has fallen by H may be faster by the
  /// speed of that fall.
  bool allows(const Vec3& position, const Twist& twist) const {
    const double square = allowed_square(position);
    return twist.linear.squaredNorm() < square && twist.angular.squaredNorm() * base_reach_square_ < square &&
           position.squaredNorm() < beyond * beyond;
  }
  /// (m/s)^2: of bodies of a robot whose base is there.
  double allowed_square(const Vec3& position) const {
    const double fall = gravity_.dot(position) - start_;
    return speed_square_ + (fall > 0 ? 2 * fall : 0);
  }
  bool allows_depth(double depth) const { return !(depth > depth_); }
  double depth() const { return depth_; }

  /// The end of a message that begins with the name of the robot: how fast it is, and what may be.
  std::string speed_text(const Vec3& position, const Twist& twist) const;
  /// The same of one of its joints or of a body, `what`, at `speed` (m/s).
  std::string speed_text(const Vec3& position, const std::string& what, double speed) const;
  /// The same of a link `what` that is `depth` (m) deep in the scenery `obstacle`.
  std::string depth_text(const std::string& what, const std::string& obstacle, double depth) const;

 private:
  Vec3 gravity_ = Vec3::Zero();
  double start_ = 0;  ///< J/kg: gravity times the place of the start
  double speed_square_ = beyond * beyond;
  double base_reach_square_ = 1;  ///< m^2
  double depth_ = beyond;
  double own_speed_ = 0;  ///< m/s: that of `watch_speed`, or by drives; 0: off
  bool speed_is_given_ = false, depth_is_given_ = false;
};

/// Why a robot is too deep in something.
inline constexpr const char* cause_of_depth =
    "it is pushed in harder than its contacts hold, or has moved farther than its own size in a step";
/// How a message on a watch ends.
std::string how_to_go_on(std::string_view parameter);

}  // namespace muro::watch
