// SPDX-License-Identifier: MIT
// Footsteps for a linear inverted pendulum. Feet are put down so that the capture point stays ahead of them as in a
// periodic walk (Englsberger et al., IROS 2011; Khadiv et al., IEEE T-RO 2020: step adjustment). Between steps it gives
// the ways of the centre of mass and of the swing foot.
//
// The pendulum falls about the centre of the stance sole. It changes feet in an instant, in the middle of double
// support. The capture point at that instant decides where the swing foot goes: a capture point that is farther away
// than planned takes the foot along, so errors do not grow.
#pragma once

#include <array>
#include <cstdint>

#include "reference.hpp"

namespace walking {

/// Velocity of the trunk in its own axes: m/s forward, m/s to the left, rad/s to the left.
struct Velocity {
  double forward = 0, left = 0, turn = 0;

  bool is_zero() const { return forward == 0 && left == 0 && turn == 0; }
};

struct GaitSettings {
  double period = 0.35;         ///< s, duration of a step
  double double_support = 0.2;  ///< share of the period in which both feet are on the ground
  double shift = 0.3;           ///< s, duration of the weight shift before the first step and after the last one
  double rise = 0.03;           ///< m, height of the swing foot
  double foot_distance = 0.1;   ///< m, from sole to sole
  double com_height = 0.25;     ///< m, above the soles
  Velocity largest_step;        ///< m, m, rad, in one step
  Velocity largest_change;      ///< m, m, rad: from a step to the next of the same foot
  double w() const;             ///< rad/s, of the pendulum
};

class Gait {
 public:
  enum Phase : std::int64_t { standing, shifting_in, stepping, shifting_out };

  /// Stands with the middle between both feet at `middle`.
  void stand(const Foothold& middle, const GaitSettings& g);
  /// Advances by `h` s. A command of zero ends the walk with feet side by side.
  void advance(double h, const Velocity& command, const GaitSettings& g);
  /// Takes the error of the capture point (m, ahead of its planned place): the swing foot compensates it.
  void find_astray(double ahead, const GaitSettings& g);

  Phase phase() const { return phase_; }
  /// Returns the foot that carries. While both feet carry, it is the foot that carries next or carried last.
  Side stance() const { return stance_; }
  const Pendulum& along_x() const { return x_; }
  const Pendulum& along_y() const { return y_; }
  double yaw() const { return yaw_; }  ///< yaw of the trunk
  SolePlace sole(Side side, const GaitSettings& g) const;
  Reference reference(const GaitSettings& g) const;
  const Foothold& target() const { return target_; }

 private:
  Foothold middle() const;
  Foothold stride(Side swing, const GaitSettings& g) const;
  void begin_step(const Velocity& command, const GaitSettings& g);
  void end_step(const Velocity& command, const GaitSettings& g);
  /// Returns 0 with the weight on both feet, 1 in the middle of single support.
  double lift(const GaitSettings& g) const;
  /// Returns the share of the weight on the left foot.
  double share(const GaitSettings& g) const;
  void begin_shift(Phase phase, double xi_x, double xi_y, const GaitSettings& g);
  void settle(double h, const GaitSettings& g);
  void place_swing_foot(const GaitSettings& g);
  double swing_part(const GaitSettings& g) const;

  std::array<Foothold, 2> feet_;  ///< where they stand, or stood last
  Foothold target_;               ///< place where the swing foot goes
  Foothold xi_;                   ///< capture point when the swing foot begins to carry
  double astray_ = 0;             ///< m, error of the capture point at the end of the step
  Velocity speed_;                ///< velocity for which steps are made
  Pendulum x_, y_;
  double zmp_x_ = 0, zmp_y_ = 0;
  double yaw_ = 0, yaw_before_ = 0;
  double time_ = 0;
  Phase phase_ = standing;
  Side stance_ = left_side;
  std::int64_t steps_in_place_ = 0;
};

}  // namespace walking
