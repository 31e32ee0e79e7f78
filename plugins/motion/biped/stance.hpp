// SPDX-License-Identifier: MIT
// The foot that stands, its place, and the rules of the README by which it changes.
#pragma once

#include "feet.hpp"
#include "ground_plane.hpp"

namespace muro::biped {

/// Stance of a robot.
struct Stance {
  std::uint32_t foot = 0;       ///< number of the foot that stands
  bool is_flush = true;         ///< its sole lies on the plane; else it waits until the other foot allows that
  Pose pose;                    ///< pose of the link of the stance foot in the world: frozen
  std::uint64_t footholds = 0;  ///< number of times that a foot has been put down
};

/// Poses of both feet in the frame of the base.
struct FootPoses {
  std::array<Pose, 2> foot;
  /// Returns the other foot in the frame of foot `i`.
  Pose other(std::uint32_t i) const { return foot[i].inverse() * foot[1 - i]; }
};

/// Positions of the joints of both legs in a step: they change evenly from `from` to `to`. rad or m.
struct LegPositions {
  std::span<const double> from, to;
  double at(std::uint32_t i, double s) const { return from[i] + s * (to[i] - from[i]); }
};

/// A pair of feet on a plane.
class Footing {
 public:
  Footing(const Feet& feet, const GroundPlane& plane, double hysteresis)
      : feet_(feet), plane_(plane), hysteresis_(hysteresis) {}

  /// Returns both feet at the part `s` (0 to 1) of the step.
  FootPoses feet_at(const LegPositions& q, double s) const;
  /// Returns the height above the plane of the lowest point of the sole of foot `i` (m), whose link is at `foot`.
  double height(std::uint32_t i, const Pose& foot) const;

  /// Puts the robot on its feet wherever it is: after a start, a hand-over, or a move from outside. `base`: its pose.
  Stance stand_up(const Pose& base, const FootPoses& feet, const Stance& before) const;
  /// Moves the stance through a step in which the legs follow `q`; `end`: the feet at its end. Returns the height of
  /// the sole of the swing foot at the end (m).
  double walk(const LegPositions& q, const FootPoses& end, Stance& stance) const;

 private:
  Pose touching(std::uint32_t i, Pose foot) const;
  Pose flush(std::uint32_t i, const Pose& foot) const;
  /// Whether the other foot, at `other` in the frame of foot `i`, is above the plane when foot `i` is at `foot`.
  bool leaves_room(std::uint32_t i, const Pose& foot, const Pose& other) const;
  /// Makes foot `i` the stance foot, at the place where it touches at `foot`.
  void put_down(std::uint32_t i, Pose foot, const FootPoses& feet, Stance& stance) const;
  void lie_down_flat(const FootPoses& feet, Stance& stance) const;
  Stance stand_on_edges(const Pose& base, const FootPoses& feet, const Stance& before) const;
  double crossing(const LegPositions& q, const Stance& stance, double from, double last_height) const;

  const Feet& feet_;
  const GroundPlane& plane_;
  double hysteresis_;  ///< m
};

}  // namespace muro::biped
