// SPDX-License-Identifier: MIT
// Numbers of a robot and of its walk, which the scenario sets as tunables. The defaults fit
// examples/models/humanoid.urdf.
#pragma once

#include "balance.hpp"
#include "body.hpp"
#include "gait.hpp"
#include "joints.hpp"
#include "kick.hpp"
#include "muro_controller.hpp"

namespace walking {

// The order of `tunables`.
enum Tunable {
  // clang-format off
  t_forward, t_left, t_turn,
  t_period, t_double_support, t_shift, t_rise, t_foot_distance, t_trunk_height, t_lean,
  t_step_forward, t_step_left, t_step_turn, t_change,
  t_hip_x, t_hip_y, t_hip_z, t_hip_pitch_x, t_hip_pitch_z, t_leg_y, t_thigh, t_knee_x, t_shin, t_ankle_x, t_ankle_z,
  t_sole_x, t_sole_y, t_sole_z,
  t_mass, t_leg_mass, t_leg_com, t_upper_com_x, t_upper_com_z, t_stiffness,
  t_shoulder_pitch, t_shoulder_roll, t_elbow,
  t_ankle_pitch_tilt, t_ankle_pitch_rate, t_ankle_roll_tilt, t_ankle_roll_rate,
  t_hip_pitch_tilt, t_hip_pitch_rate, t_hip_roll_tilt, t_hip_roll_rate,
  t_capture, t_tolerance, t_delay, t_smoothing,
  t_feedback, t_attitude, t_heading, t_prepare, t_calibrate,
  t_kick_shift, t_kick_swing, t_kick_back, t_kick_forward, t_kick_rise, t_kick_outward,
  // clang-format on
};

inline constexpr muro_tunable tunable_table[] = {
    {"forward", "m/s", 0.1, -2, 2, "velocity of the trunk, where no walk.command is connected"},
    {"left", "m/s", 0, -2, 2, "the same to the left"},
    {"turn", "rad/s", 0, -4, 4, "the same, to the left"},
    {"period", "s", 0.36, 0.1, 3, "of a step"},
    {"double_support", "1", 0.2, 0, 0.9, "share of the period with both feet on the ground"},
    {"shift", "s", 0.36, 0.05, 3, "in which the weight is shifted before the first and after the last step"},
    {"rise", "m", 0.025, 0, 1, "of the swing foot"},
    {"foot_distance", "m", 0.09, 0.01, 2, "between the centres of the soles"},
    {"trunk_height", "m", 0.255, 0.01, 5, "of the trunk's origin above the soles"},
    {"lean", "rad", 0, -1, 1, "of the trunk, nose down"},
    {"step_forward", "m", 0.1, 0, 2, "the longest step"},
    {"step_left", "m", 0.08, 0, 2, "by which feet come apart at most in a step to the side"},
    {"step_turn", "rad", 0.3, 0, 2, "the largest turn of a step"},
    {"change", "1", 0.2, 0.01, 1, "of the longest step: by which a step may differ from the one before"},
    {"hip_x", "m", 0, -1, 1, "where the axes of hip yaw and roll meet, ahead of the trunk's origin"},
    {"hip_y", "m", 0.035, 0, 1, "to the side of it"},
    {"hip_z", "m", -0.0285, -2, 2, "above it"},
    {"hip_pitch_x", "m", 0.0001, -1, 1, "axis of hip pitch ahead of that point"},
    {"hip_pitch_z", "m", 0, -1, 1, "above it"},
    {"leg_y", "m", 0, -1, 1, "axis of ankle roll outwards of that of hip roll"},
    {"thigh", "m", 0.11015, 0.001, 3, "from hip pitch down to the knee"},
    {"knee_x", "m", 0, -1, 1, "knee ahead of hip pitch"},
    {"shin", "m", 0.11, 0.001, 3, "from the knee down to ankle pitch"},
    {"ankle_x", "m", 0, -1, 1, "ankle pitch ahead of the knee"},
    {"ankle_z", "m", 0, -1, 1, "axis of ankle roll below that of ankle pitch"},
    {"sole_x", "m", 0.0024, -1, 1, "centre of the sole ahead of ankle pitch"},
    {"sole_y", "m", 0.01, -1, 1, "outwards of the axis of ankle roll"},
    {"sole_z", "m", 0.0305, 0, 1, "below it"},
    {"mass", "kg", 3.147, 0.01, 1000, "of the robot"},
    {"leg_mass", "1", 0.189, 0, 0.49, "share of each leg in the mass"},
    {"leg_com", "1", 0.48, 0, 1, "where a leg has its mass, from hip (0) to sole (1)"},
    {"upper_com_x", "m", -0.0112, -1, 1, "centre of mass of all but the legs, ahead of the trunk's origin"},
    {"upper_com_z", "m", 0.07, -2, 2, "above it"},
    {"stiffness", "N m/rad", 24.9, 0, 1e6, "of the legs' position drives; 0: they do not give way"},
    {"shoulder_pitch", "rad", 0, -4, 4, "of both arms"},
    {"shoulder_roll", "rad", -1.3, -4, 4, "of the left arm"},
    {"elbow", "rad", -0.4, -4, 4, "of the left arm"},
    {"ankle_pitch_tilt", "1", 0.3, -10, 10, "feedback of the trunk's pitch"},
    {"ankle_pitch_rate", "s", 0.12, -10, 10, "of its pitch rate"},
    {"ankle_roll_tilt", "1", 0.3, -10, 10, "of its roll"},
    {"ankle_roll_rate", "s", 0.12, -10, 10, "of its roll rate"},
    {"hip_pitch_tilt", "1", 0, -10, 10, "the same to the hips of the legs that carry"},
    {"hip_pitch_rate", "s", 0, -10, 10, "the same"},
    {"hip_roll_tilt", "1", 0, -10, 10, "the same"},
    {"hip_roll_rate", "s", 0, -10, 10, "the same"},
    {"capture", "1", 0.7, 0, 2, "share of what the capture point is off ahead, for the swing foot to make up for"},
    {"tolerance", "m", 0.02, 0, 1, "that the capture point may be off"},
    {"delay", "s", 0.05, 0, 0.3, "by which the body follows the gait"},
    {"smoothing", "s", 0.03, 0, 1, "of the velocity of the centre of mass"},
    {"feedback", "1", 1, 0, 10, "share of all feedback but that of the heading"},
    {"attitude", "1/s", 0.5, 0, 100, "how fast the attitude follows the accelerometer"},
    {"heading", "1/s", 3, 0, 100, "how fast a wrong heading is turned back"},
    {"prepare", "s", 0.6, 0.01, 60, "to come to the posture of the walk"},
    {"calibrate", "s", 1, 0, 60, "at rest, to measure the biases of the IMU; 0: it is taken to have none"},
    {"kick_shift", "s", 0.5, 0.05, 10, "in which the weight goes over one foot before a kick, and back after it"},
    {"kick_swing", "s", 0.4, 0.05, 10, "in which the other foot is taken back, and in which it is put down"},
    {"kick_back", "m", 0.075, 0, 2, "by which it is taken back"},
    {"kick_forward", "m", 0.143, 0, 2, "ahead of where it stood, at the end of its way forward"},
    {"kick_rise", "m", 0.057, 0, 2, "of its sole"},
    {"kick_outward", "m", -0.008, -1, 1, "of the centre of mass from the centre of the sole that carries"},
};

struct Settings {
  /// `t`: values of the tunables, in their order. Times become whole steps of `h` s.
  Settings(const double* t, double h);

  Velocity command;
  GaitSettings gait;
  BodyDimensions body;
  BalanceSettings balance;
  KickSettings kick;
  ArmAngles arm;
  double trunk_height, lean, attitude, heading, prepare, calibrate;
};

}  // namespace walking
