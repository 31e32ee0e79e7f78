// SPDX-License-Identifier: MIT
// A joint driven by a motor at a voltage: what it reads and writes, and one run of it.
#pragma once

#include <string>

#include "motor_parameters.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::servo {

inline constexpr Key<double> supply_voltage_key{"servo.supply_voltage", "V", "what feeds the servo", Role::command};
inline constexpr Key<double> torque_enable_key{"servo.torque_enable", "1",
                                               "0: the coil is open, the motor gives nothing", Role::command};
inline constexpr Key<double> p_gain_key{"servo.p_gain", "1", "of the firmware, in its units", Role::command};
inline constexpr Key<double> duty_key{"servo.duty", "1", "part of the supply voltage at the coil, -1 .. 1"};

class VoltageDrive {
 public:
  VoltageDrive() = default;
  /// `base`: of the robot; `inertia`: kg m^2, what the joint moves at the start, with its own armature. [setup]
  VoltageDrive(Connector& c, ObjectId base, ObjectId joint, const MotorParameters& m, double inertia)
      : model_(m.model), inertia_(inertia + m.model.armature) {
    supply_voltage_ = c.input(joint, supply_voltage_key, m.supply_voltage);
    torque_enable_ = c.input(joint, torque_enable_key, 1.0);
    p_gain_ = c.input(joint, p_gain_key, m.p_gain);
    duty_ = c.derived(joint, duty_key);
    friction_ = c.derived(joint, keys::joint_drive_friction);
    armature_ = c.derived(joint, keys::joint_drive_armature);
    if (!model_.friction.depends_on_load()) return;
    last_ = static_cast<LastRun*>(c.state_block(joint, "motor.servo", sizeof(LastRun)));
    if (!c.constant_array(base, keys::motion_level_names).empty()) level_ = c.read(base, keys::motion_level);
  }
  explicit operator bool() const { return bool(duty_); }

  /// The effort (N m) of the motor with the position's error `error` (rad) at `velocity` (rad/s). Throws Error where
  /// the period `dt` (s) is too long for its back EMF.
  double run(double error, double velocity, double dt) const {
    if (model_.back_emf_damping() * dt > inertia_) throw too_slow(dt);
    const bool on = *torque_enable_ != 0;
    if (last_) begin_anew_at_handover();
    *duty_ = on ? model_.duty(*p_gain_ * error) : 0;
    const double torque = on ? model_.torque(*duty_ * *supply_voltage_, velocity) : 0;
    *friction_ = model_.friction.budget(velocity, torque, last_ ? observed_load(velocity, dt) : 0);
    *armature_ = model_.armature;
    if (last_) last_->velocity = velocity, last_->torque = torque, last_->budget = *friction_, last_->has_run = 1;
    return torque;
  }

 private:
  /// Part of the state; all 0 before the first run.
  struct LastRun {
    double has_run, velocity, torque, budget, load, level;
  };

  /// How the joint has moved under another motion says nothing of this one's load: that need not take efforts.
  void begin_anew_at_handover() const {
    const double level = level_ ? double(*level_) : 0;
    if (level == last_->level) return;
    *last_ = LastRun{};
    last_->level = level;
  }
  double observed_load(double velocity, double dt) const {
    if (last_->has_run != 0)
      last_->load = motor::LoadObserver::load(velocity, velocity - last_->velocity, last_->torque, last_->budget,
                                              inertia_, last_->load, dt);
    return last_->load;
  }
  Error too_slow(double dt) const {
    return Error("the back EMF would stop the joint within " + std::to_string(inertia_ / model_.back_emf_damping()) +
                 " s, which is less than the period of " + std::to_string(dt) +
                 " s; give the motor its `armature`, or a higher `rate`");
  }

  motor::MotorModel model_;
  double inertia_ = 0;  ///< kg m^2, with the armature
  In<double> supply_voltage_, torque_enable_, p_gain_;
  Out<double> duty_, friction_, armature_;
  In<std::uint32_t> level_;  ///< which motion moves the robot, where there are several
  LastRun* last_ = nullptr;  ///< where friction depends on the load
};

}  // namespace muro::servo
