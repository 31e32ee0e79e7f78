// SPDX-License-Identifier: MIT
// Which foot stands, where, and what makes it change: the rules of the README.
#pragma once

#include "feet.hpp"
#include "ground_plane.hpp"

namespace muro::biped {

/// What a robot keeps of its stance.
struct Stance {
  std::uint32_t foot = 0;       ///< which one stands
  bool is_flush = true;         ///< its sole lies on the plane; else it waits until the other foot lets it
  Pose pose;                    ///< of the link of the stance foot in the world: frozen
  std::uint64_t footholds = 0;  ///< how often a foot has been put down
};

/// Both feet in the frame of the base.
struct FootPoses {
  std::array<Pose, 2> foot;
  /// The other foot in the frame of foot `i`.
  Pose other(std::uint32_t i) const { return foot[i].inverse() * foot[1 - i]; }
};

/// The positions of the joints of both legs in a step: even from `from` to `to`. rad or m.
struct LegPositions {
  std::span<const double> from, to;
  double at(std::uint32_t i, double s) const { return from[i] + s * (to[i] - from[i]); }
};

/// A pair of feet on a plane.
class Footing {
 public:
  Footing(const Feet& feet, const GroundPlane& plane, double hysteresis)
      : feet_(feet), plane_(plane), hysteresis_(hysteresis) {}

  /// Both feet at the part `s` (0 to 1) of the step.
  FootPoses feet_at(const LegPositions& q, double s) const;
  /// m, of the lowest point of the sole of foot `i`, whose link is at `foot`, above the plane.
  double height(std::uint32_t i, const Pose& foot) const;

  /// Puts the robot on its feet wherever it is: after a start, a hand-over or when it was put elsewhere. `base`: of it.
  Stance stand_up(const Pose& base, const FootPoses& feet, const Stance& before) const;
  /// Carries the stance through a step in which the legs go as `q` says; `end`: the feet at its end. Returns the height
  /// (m) of the sole of the swing foot then.
  double walk(const LegPositions& q, const FootPoses& end, Stance& stance) const;

 private:
  Pose touching(std::uint32_t i, Pose foot) const;
  Pose flush(std::uint32_t i, const Pose& foot) const;
  /// Whether foot `i` at `foot` leaves the other one, at `other` in its frame, above the plane.
  bool leaves_room(std::uint32_t i, const Pose& foot, const Pose& other) const;
  /// Foot `i` stands from now on, where it touches at `foot`.
  void put_down(std::uint32_t i, Pose foot, const FootPoses& feet, Stance& stance) const;
  void lie_down_flat(const FootPoses& feet, Stance& stance) const;
  Stance stand_on_edges(const Pose& base, const FootPoses& feet, const Stance& before) const;
  double crossing(const LegPositions& q, const Stance& stance, double from, double last_height) const;

  const Feet& feet_;
  const GroundPlane& plane_;
  double hysteresis_;  ///< m
};

}  // namespace muro::biped
