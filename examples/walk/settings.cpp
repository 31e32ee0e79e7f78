// SPDX-License-Identifier: MIT
#include "settings.hpp"

#include <cmath>
#include <iterator>

namespace walking {

static_assert(std::size(tunable_table) == t_kick_outward + 1);

namespace {

double whole_steps(double seconds, double h) { return std::fmax(1, std::round(seconds / h)) * h; }

/// Returns the gains of tilt and of rate, which follow each other in `t`.
Gains gains_of(const double* t, Tunable tilt) { return {t[t_feedback] * t[tilt], t[t_feedback] * t[tilt + 1]}; }

LegDimensions leg_of(const double* t) {
  return {.hip = {t[t_hip_x], t[t_hip_y], t[t_hip_z]},
          .hip_pitch_x = t[t_hip_pitch_x],
          .hip_pitch_z = t[t_hip_pitch_z],
          .leg_y = t[t_leg_y],
          .thigh = t[t_thigh],
          .knee_x = t[t_knee_x],
          .shin = t[t_shin],
          .ankle_x = t[t_ankle_x],
          .ankle_z = t[t_ankle_z],
          .sole_x = t[t_sole_x],
          .sole_y = t[t_sole_y],
          .sole_z = t[t_sole_z]};
}

}  // namespace

Settings::Settings(const double* t, double h)
    : command{t[t_forward], t[t_left], t[t_turn]},
      body{.leg = leg_of(t),
           .upper_com = {t[t_upper_com_x], 0, t[t_upper_com_z]},
           .mass = t[t_mass],
           .leg_mass = t[t_leg_mass],
           .leg_com = t[t_leg_com],
           .stiffness = t[t_stiffness]},
      balance{.ankle_pitch = gains_of(t, t_ankle_pitch_tilt),
              .ankle_roll = gains_of(t, t_ankle_roll_tilt),
              .hip_pitch = gains_of(t, t_hip_pitch_tilt),
              .hip_roll = gains_of(t, t_hip_roll_tilt),
              .capture = t[t_feedback] * t[t_capture],
              .tolerance = t[t_tolerance],
              .delay = t[t_delay],
              .smoothing = t[t_smoothing]},
      arm{t[t_shoulder_pitch], t[t_shoulder_roll], t[t_elbow]},
      trunk_height(t[t_trunk_height]),
      lean(t[t_lean]),
      attitude(t[t_attitude]),
      heading(t[t_heading]),
      prepare(t[t_prepare]),
      calibrate(t[t_calibrate]) {
  gait = {.period = whole_steps(t[t_period], h),
          .double_support = t[t_double_support],
          .shift = whole_steps(t[t_shift], h),
          .rise = t[t_rise],
          .foot_distance = t[t_foot_distance],
          .com_height = Body(body).com_height(trunk_height),
          .largest_step = {t[t_step_forward], t[t_step_left], t[t_step_turn]},
          .largest_change = {t[t_change] * t[t_step_forward], 0.5 * t[t_change] * t[t_step_left],
                             0.5 * t[t_change] * t[t_step_turn]}};
  kick = {.shift = whole_steps(t[t_kick_shift], h),
          .swing = whole_steps(t[t_kick_swing], h),
          .back = t[t_kick_back],
          .forward = t[t_kick_forward],
          .rise = t[t_kick_rise],
          .outward = t[t_kick_outward],
          .com_height = gait.com_height};
}

}  // namespace walking
