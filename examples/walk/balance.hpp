// SPDX-License-Identifier: MIT
// Feedback: ankles and hips act against tilt and rotation of the trunk (as the walking module of ROBOTIS OP3 does). The
// swing foot compensates the error of the capture point from the gait.
#pragma once

#include <array>
#include <cstdint>

#include "attitude.hpp"
#include "body.hpp"

namespace walking {

/// Angles for a tilt of 1 rad, and for a rotation of 1 rad/s (s).
struct Gains {
  double tilt = 0, rate = 0;
};

struct BalanceSettings {
  Gains ankle_pitch, ankle_roll, hip_pitch, hip_roll;
  double capture = 0;       ///< share of the capture point's error, ahead, that the swing foot compensates
  double tolerance = 0.01;  ///< m, error that does not count
  double delay = 0.05;      ///< s, lag of the body behind the gait
  double smoothing = 0.03;  ///< s, time constant of the speed at which the centre of mass leaves the gait
};

class Balance {
 public:
  /// Returns the error of the capture point, m ahead, less `tolerance`, from the places of the soles in the trunk's
  /// frame by the joints. `w`: rad/s, of the pendulum. Called every `h` s.
  double astray(const Reference& now, double w, const Body& body, const Attitude& attitude,
                const std::array<Frame, 2>& soles, const BalanceSettings& b, double h);
  /// Forgets the past: the robot was somewhere else.
  void clear() { *this = {}; }

 private:
  static constexpr std::int64_t room = 64;

  std::array<std::array<double, 2>, room> past_{};  ///< centre of mass of the gait in the past
  double off_ = 0, drift_ = 0;                      ///< m and m/s, of the centre of mass ahead of the gait
  std::int64_t seen_ = 0, stance_ = -1;
};

/// Adds the feedback to the angles of the legs that carry. Gains are for springs, which turn angles into moments:
/// `springs` is 1 for springs and 0 for joints that always meet their targets.
void keep_balance(BothLegs& angles, const Reference& now, const Attitude& attitude, double lean,
                  const BalanceSettings& b, double springs);

}  // namespace walking
