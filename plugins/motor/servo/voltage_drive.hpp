// SPDX-License-Identifier: MIT
// A joint driven by a motor at a voltage: its properties, and one run of it.
#pragma once

#include <limits>
#include <string>

#include "motor_parameters.hpp"
#include "muro/base/number_text.hpp"
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
  /// `inertia`: kg m^2, moved by the joint at the start, including the joint's own armature. [setup]
  VoltageDrive(Connector& c, ObjectId joint, const MotorParameters& m, double inertia)
      : model_(m.model), inertia_(inertia + m.model.armature), joint_(c.object_name(joint)) {
    supply_voltage_ = c.input(joint, supply_voltage_key, m.supply_voltage);
    torque_enable_ = c.input(joint, torque_enable_key, 1.0);
    p_gain_ = c.input(joint, p_gain_key, m.p_gain);
    duty_ = c.derived(joint, duty_key);
    friction_ = c.derived(joint, keys::joint_drive_friction);
    armature_ = c.derived(joint, keys::joint_drive_armature);
    if (model_.friction.depends_on_load())
      last_ = static_cast<LastRun*>(c.state_block(joint, "motor.servo", sizeof(LastRun)));
  }
  explicit operator bool() const { return bool(duty_); }

  /// Returns the effort (N m) of the motor for the position error `error` (rad) at `velocity` (rad/s). `acts`: a motion
  /// by forces has moved the joint, so the velocity shows the load. Throws Error when the period `dt` (s) is too long
  /// for the back EMF, and for a commanded voltage or gain that is not a finite number, 0 or more.
  double run(double error, double velocity, bool acts, double dt) const {
    if (model_.back_emf_damping() * dt > inertia_) throw too_slow(dt);
    if (!is_command(*supply_voltage_)) throw no_command(supply_voltage_key, *supply_voltage_);
    if (!is_command(*p_gain_)) throw no_command(p_gain_key, *p_gain_);
    const bool on = *torque_enable_ != 0;
    if (last_ && !acts) *last_ = {};
    *duty_ = on ? model_.duty(*p_gain_ * error) : 0;
    const double torque = on ? model_.torque(*duty_ * *supply_voltage_, velocity) : 0;
    *friction_ = model_.friction.budget(velocity, torque, last_ ? observed_load(velocity, dt) : 0);
    *armature_ = model_.armature;
    if (last_) last_->velocity = velocity, last_->torque = torque, last_->budget = *friction_, last_->has_run = 1;
    return torque;
  }

 private:
  /// Data of the last run, a part of the state; all 0 before the first run. A run in which a motion without forces
  /// moved the robot resets them, since it says nothing about the load.
  struct LastRun {
    double has_run, velocity, torque, budget, load;
  };

  double observed_load(double velocity, double dt) const {
    if (last_->has_run != 0)
      last_->load = motor::LoadObserver::load(velocity, velocity - last_->velocity, last_->torque, last_->budget,
                                              inertia_, last_->load, dt);
    return last_->load;
  }
  static bool is_command(double x) { return x >= 0 && x <= std::numeric_limits<double>::max(); }
  Error no_command(const KeyInfo& key, double value) const {
    return Error(quote(joint_ + ":" + std::string(key.name)) + " is " + number_text(value) +
                 (key.unit == "1" ? "" : " " + std::string(key.unit)) + "; command a finite number, 0 or more");
  }
  Error too_slow(double dt) const {
    return Error("the back EMF would stop the joint within " + number_text(inertia_ / model_.back_emf_damping()) +
                 " s, which is less than the period of " + number_text(dt) +
                 " s; give the motor its `armature`, or a higher `rate`");
  }

  motor::MotorModel model_;
  double inertia_ = 0;  ///< kg m^2, with the armature
  In<double> supply_voltage_, torque_enable_, p_gain_;
  Out<double> duty_, friction_, armature_;
  std::string joint_;        ///< name of the joint, for messages
  LastRun* last_ = nullptr;  ///< used when friction depends on the load
};

}  // namespace muro::servo
