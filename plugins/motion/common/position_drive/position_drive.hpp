// SPDX-License-Identifier: MIT
// Drives that follow positions: PD controllers at the joints that run in each step of the motion.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "muro/toolkit/joint_drives.hpp"

namespace muro {

// Parameters of a motion with position drives.
inline constexpr Parameter natural_frequency =
    real("natural_frequency", "rad/s", 100,
         "of position drives with neither stiffness nor damping given: both follow from the inertia that the joint "
         "moves, critically damped")
        .between(1e-3, 1e5);
inline constexpr Parameter drive_stiffness = texts(
    "stiffness",
    "of position drives, N m/rad or N/m: a number, or a map of joints (`*` ends a name); MJCF's kp, ros2_control's p");
inline constexpr Parameter drive_damping = texts(
    "damping",
    "of position drives, N m s/rad or N s/m: a map of joints, `*` at the end of a name; MJCF's kv, ros2_control's "
    "d");
inline constexpr Parameter interpolate =
    real("interpolate", "s", 0,
         "period of the controller, in which position targets move evenly to a new value; 0: they jump")
        .between(0, 10);

/// effort = stiffness (target - position) + damping (target velocity - velocity).
struct PdGains {
  double stiffness = 0;  ///< N m/rad or N/m
  double damping = 0;    ///< N m s/rad or N s/m
};

/// Settings of a drive that follows positions.
struct PositionDrive {
  double natural_frequency = 100;                ///< rad/s
  std::optional<double> stiffness{}, damping{};  ///< when given
  double interpolation = 0;                      ///< s, time in which a target moves to a new value

  bool needs_inertia() const { return !stiffness || !damping; }
  /// Returns the gains. A gain that is not given is chosen so that the joint is a critically damped oscillator with
  /// `inertia` (kg m^2 or kg).
  PdGains gains(double inertia) const;
};

/// A PD drive within a step, as a damper with `damping` (N m s/rad or N s/m) that pulls to `velocity` (rad/s or m/s).
struct ImplicitDrive {
  double velocity = 0;
  double damping = 0;

  /// Returns the effort (N m or N) when the joint has this velocity at the end of the step.
  double effort(double end_velocity) const { return damping * (velocity - end_velocity); }
};

/// Returns the drive with the effort from position and velocity at the end of the step, q' = q + v' dt. It is stable
/// for all gains:
///     stiffness (target - q - v' dt) + damping (target velocity - v').
/// As a constraint it has ERP = dt kp / (dt kp + kd) and CFM = 1 / (dt kp + kd) (ODE manual, 3.8). `error`: target - q.
ImplicitDrive implicit_drive(const PdGains& gains, double error, double target_velocity, double dt);

/// Returns one drive per link; only those of joints in mode `position` count. Throws Error for names that match no
/// joint and for values that are not numbers >= 0. [setup]
std::vector<PositionDrive> position_drives_of(const Connector& connector, const RobotView& robot,
                                              std::span<const DriveMode> modes, const Parameters& p);

}  // namespace muro
