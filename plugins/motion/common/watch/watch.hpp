// SPDX-License-Identifier: MIT
// Ends a run that has become unstable. Forces that grow from step to step, or bodies that sink into the scenery, give
// numbers that look like results.
#pragma once

#include <string>

#include "reach.hpp"

namespace muro::watch {

/// m, m/s, rad/s: engines that diverge exceed this value.
inline constexpr double beyond = 1e12;

/// Whether a body can have this pose and twist: finite numbers, and an orientation that can be normalised.
inline bool is_somewhere(const Pose& pose, const Twist& twist) {
  const double norm = pose.orientation.squaredNorm();
  return pose.position.squaredNorm() < beyond * beyond && twist.linear.squaredNorm() < beyond * beyond &&
         twist.angular.squaredNorm() < beyond * beyond && norm > 0.25 && norm < 4;
}

/// The limits of one robot. It is no part of the state: it can only end a run, not change it.
class Watch {
 public:
  /// Only finds numbers that are impossible for a body (beyond 1e12).
  Watch() = default;
  /// Sets the limits from the parameters of `parameters.hpp`, if the watch is on, and from the robot's size and drives.
  /// [setup]
  Watch(const Connector& c, const Parameters& p, const Reach& reach);

  /// Raises the speed limit because something other than contacts and drives pushes the robot. [setup]
  void allow_pushes();
  /// Sets the start when the run begins or continues. The present speed and the speed of a fall from here are no
  /// failure.
  void begin(const Vec3& position, const Twist& twist);
  /// Takes the deepest overlap (m) with scenery at the start. A robot that starts deep in a wall has time to leave it.
  void begin_overlap(double depth);

  /// Whether a base may move like this; false when the motion is not finite. A body that has fallen by a height may be
  /// faster by the speed of that fall.
  bool allows(const Vec3& position, const Twist& twist) const {
    const double square = allowed_square(position);
    return twist.linear.squaredNorm() < square && twist.angular.squaredNorm() * base_reach_square_ < square &&
           position.squaredNorm() < beyond * beyond;
  }
  /// (m/s)^2: limit for the bodies of a robot whose base is at `position`.
  double allowed_square(const Vec3& position) const {
    const double fall = gravity_.dot(position) - start_;
    return speed_square_ + (fall > 0 ? 2 * fall : 0);
  }
  bool allows_depth(double depth) const { return !(depth > depth_); }
  double depth() const { return depth_; }

  /// Returns the end of a message that begins with the name of the robot: its speed, and the limit.
  std::string speed_text(const Vec3& position, const Twist& twist) const;
  /// Returns the end of such a message for one of its joints or a body, `what`, at `speed` (m/s).
  std::string speed_text(const Vec3& position, const std::string& what, double speed) const;
  /// Returns the end of such a message for a link `what` that is `depth` (m) deep in the scenery `obstacle`.
  std::string depth_text(const std::string& what, const std::string& obstacle, double depth) const;

 private:
  Vec3 gravity_ = Vec3::Zero();
  double start_ = 0;  ///< J/kg: gravity times the position at the start
  double speed_square_ = beyond * beyond;
  double base_reach_square_ = 1;  ///< m^2
  double depth_ = beyond;
  double own_speed_ = 0;  ///< m/s: from `watch_speed`, or by drives; 0: off
  bool speed_is_given_ = false, depth_is_given_ = false;
};

/// Cause of a robot that is too deep in something.
inline constexpr const char* cause_of_depth =
    "it is pushed in harder than its contacts hold, or has moved farther than its own size in a step";
/// Returns the end of a message on a watch: how to allow the motion.
std::string how_to_go_on(std::string_view parameter);

}  // namespace muro::watch
