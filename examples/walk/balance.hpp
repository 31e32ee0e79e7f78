// SPDX-License-Identifier: MIT
// Feedback: ankles and hips against what the trunk tilts and turns (as the walking module of ROBOTIS OP3 does), and how
// far the capture point is from where the gait has it, for the swing foot to make up for it.
#pragma once

#include <array>
#include <cstdint>

#include "attitude.hpp"
#include "body.hpp"

namespace walking {

/// Angles for a tilt of 1 rad, and for a turn of 1 rad/s (s).
struct Gains {
  double tilt = 0, rate = 0;
};

struct BalanceSettings {
  Gains ankle_pitch, ankle_roll, hip_pitch, hip_roll;
  double capture = 0;       ///< share of what the capture point is off by, ahead, that the swing foot makes up for
  double tolerance = 0.01;  ///< m, that do not count
  double delay = 0.05;      ///< s, by which the body follows the gait
  double smoothing = 0.03;  ///< s, of the speed at which the centre of mass goes astray
};

class Balance {
 public:
  /// How far the capture point is off, m ahead, of which `tolerance` does not count, by the places of the soles in the
  /// trunk's frame as the joints say; `w` is of the pendulum, rad/s. Call it each `h` s.
  double astray(const Reference& now, double w, const Body& body, const Attitude& attitude,
                const std::array<Frame, 2>& soles, const BalanceSettings& b, double h);
  /// Forgets what has been: the robot was somewhere else.
  void clear() { *this = {}; }

 private:
  static constexpr std::int64_t room = 64;

  std::array<std::array<double, 2>, room> past_{};  ///< the centre of mass of the gait
  double off_ = 0, drift_ = 0;                      ///< m and m/s, of the centre of mass ahead of where the gait had it
  std::int64_t seen_ = 0, stance_ = -1;
};

/// What balance adds to the angles of the legs that carry. Gains are for springs, which turn angles into
/// moments: `springs` is 1 for these and 0 for joints that nothing turns away from their targets.
void keep_balance(BothLegs& angles, const Reference& now, const Attitude& attitude, double lean,
                  const BalanceSettings& b, double springs);

}  // namespace walking
