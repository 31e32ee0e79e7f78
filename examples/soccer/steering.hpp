// SPDX-License-Identifier: MIT
// Walk of a player to a place: forwards to a far one, in small steps to a near one, around the others.
#pragma once

#include <algorithm>
#include <cmath>

#include "../common/angle.hpp"
#include "../common/place.hpp"
#include "others.hpp"

namespace soccer {

using examples::Place;
using examples::wrapped;

/// `walk.command`: forward, to the left (m/s), turn (rad/s).
struct Command {
  double x = 0, y = 0, turn = 0;
};

class Steering {
 public:
  /// Greatest velocities of a walk: m/s, m/s, rad/s.
  struct Pace {
    double forward = 0.25, sideways = 0.08, turn = 0.6;
  };
  static constexpr double elbow_room = 0.36;  ///< m: distance from other players

  Steering(const Pace& pace, const Place& me, const Others& others) : pace_(pace), me_(me), others_(&others) {}

  /// Tolerances of a place: m, rad.
  struct Room {
    double distance = 0.04, angle = 0.1;
  };
  /// Returns the command for a walk to a point, and to a heading there.
  Command go_to(const Point& target, double heading, const Room& room) const {
    const Point next = others_->detour(me_.at, target, elbow_room);
    const Point way = me_.to_own(next);
    const bool goes_around = (next - target).norm() > 0;
    if (way.norm() > near_by) return walk_to(next);
    const double off = wrapped(heading - me_.yaw);
    if (way.norm() < room.distance && !goes_around) return {0, 0, std::abs(off) > room.angle ? turning(off) : 0};
    return small_step({way.x, way.y}, goes_around ? 0 : off);
  }
  /// Returns the command for the remaining way in its own frame (m) and the angle to turn (rad).
  Command small_step(const Point& way, double off) const {
    constexpr double near = 0.2;  // m: nearer, it walks at half its pace
    const double most = way.x > near ? pace_.forward : 0.5 * pace_.forward;
    return {std::clamp(0.8 * way.x, -0.5 * pace_.forward, most),
            std::clamp(0.8 * way.y, -pace_.sideways, pace_.sideways), turning(off)};
  }
  /// Turns on the spot.
  Command turn() const { return {0, 0, pace_.turn}; }
  Command back() const { return {-0.4 * pace_.forward, 0, 0}; }
  double heading_to(const Point& p) const { return bearing(p - me_.at); }

 private:
  static constexpr double near_by = 0.3;  ///< m
  static constexpr double calm = 0.4;     ///< rad/s: greatest rate of turns near its place

  Command walk_to(const Point& target) const {
    const double off = wrapped(heading_to(target) - me_.yaw);
    return {pace_.forward * std::max(0.0, 1 - std::abs(off) / 0.8), 0, std::clamp(1.2 * off, -pace_.turn, pace_.turn)};
  }
  double turning(double off) const {
    if (std::abs(off) > 1) return std::clamp(0.6 * off, -pace_.turn, pace_.turn);
    return std::clamp(0.9 * off, -calm, calm);
  }

  Pace pace_;
  Place me_;
  const Others* others_;
};

}  // namespace soccer
