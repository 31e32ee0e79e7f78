// SPDX-License-Identifier: MIT
// Parameters of a voltage-driven motor: those of a part file and those of the scenario, which take precedence.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "muro/algorithm.hpp"
#include "muro/base/motor_model.hpp"
#include "muro/base/number_text.hpp"
#include "plugins/common/part_file/part_file.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

std::span<const ReadyPart> ready_parts();  // generated: the files parts/*.yaml

}  // namespace muro

namespace muro::servo {

/// Parameters of the motor and its amplifier.
struct MotorParameters {
  motor::MotorModel model;    ///< `gain`: for each unit of the P gain
  double p_gain = 0;          ///< P gain of the firmware, in its units
  double supply_voltage = 0;  ///< V
};

/// Names in a part file: before its sections, and in a section. All are parameters of motor.servo.
inline constexpr std::string_view amplifier_names[] = {"source", "supply_voltage", "p_gain", "duty_gain", "duty_limit"};
inline constexpr std::string_view motor_names[] = {"kt",
                                                   "resistance",
                                                   "armature",
                                                   "friction",
                                                   "viscous_friction",
                                                   "stribeck_friction",
                                                   "stribeck_velocity",
                                                   "stribeck_exponent",
                                                   "load_friction",
                                                   "load_stribeck_friction"};

/// Whether the scenario asks for a voltage-driven motor.
inline bool has_voltage(const Parameters& p) { return !p.text("part").empty() || p.real("kt") > 0; }

class MotorParameterReader {
 public:
  /// Throws Error when the part does not exist, or the file is no part file.
  MotorParameterReader(const Connector& c, const Parameters& p) : p_(p) {
    const std::string name(p.text("part"));
    if (name.empty()) {
      if (p.given("friction_model"))
        throw Error("`friction_model` chooses among those of a part; name one (`part`), or leave it out");
      return;
    }
    part_ = find_part(name, std::string(c.resolve_path(name)), ready_parts());
    part_.check_names("", amplifier_names);
    choose_section();
    part_.check_names(section_, motor_names);
  }

  MotorParameters read() const {
    MotorParameters m;
    m.supply_voltage = positive("supply_voltage", "V");
    m.model.kt = positive("kt", "N m/A");
    m.model.resistance = positive("resistance", "Ohm");
    m.model.armature = at_least_0("armature");
    m.p_gain = positive("p_gain", "the units of the firmware");
    m.model.gain = positive("duty_gain", "1/rad a unit of `p_gain`");
    m.model.duty_limit = value("duty_limit");
    if (!(m.model.duty_limit > 0 && m.model.duty_limit <= 1)) throw wrong("duty_limit", "above 0, at most 1");
    motor::FrictionModel& f = m.model.friction;
    f.coulomb = at_least_0("friction");
    f.viscous = at_least_0("viscous_friction");
    f.stribeck = at_least_0("stribeck_friction");
    f.load = at_least_0("load_friction");
    f.load_stribeck = at_least_0("load_stribeck_friction");
    f.stribeck_velocity = positive("stribeck_velocity", "rad/s");
    f.stribeck_exponent = positive("stribeck_exponent", "1");
    return m;
  }

 private:
  /// Chooses the section that the scenario names, or the last one, whose model is the most detailed.
  void choose_section() {
    const std::vector<std::string> sections = part_.sections();
    const std::string wanted(p_.text("friction_model"));
    if (sections.empty())
      throw Error(part_.name() + ": there is no section with a motor, such as `m1:` with `kt` and `resistance`");
    section_ = wanted.empty() ? sections.back() : wanted;
    for (const std::string& s : sections)
      if (s == section_) return;
    throw Error("`friction_model` is " + quote(wanted) + ", but " + part_.name() + " has " + quoted_list(sections));
  }

  double value(std::string_view name) const {
    if (p_.given(name) || section_.empty()) return p_.real(name);
    if (const std::optional<double> x = part_.number(section_, name)) return *x;
    return part_.number("", name).value_or(p_.real(name));
  }
  double positive(std::string_view name, const std::string& unit) const {
    const double x = value(name);
    if (!(x > 0)) throw Error(quote(name) + " is " + number_text(x) + "; a motor needs it above 0, in " + unit);
    return x;
  }
  double at_least_0(std::string_view name) const {
    const double x = value(name);
    if (!(x >= 0)) throw wrong(name, "0 or more");
    return x;
  }
  Error wrong(std::string_view name, const std::string& allowed) const {
    return Error(quote(name) + " is " + number_text(value(name)) + "; it is " + allowed);
  }

  const Parameters& p_;
  PartFile part_;
  std::string section_;  ///< empty: all parameters are in the scenario
};

/// Throws Error for parameters of the other kind of motor. `voltage`: whether this motor is driven by a voltage.
inline void check_kind_of_motor(const Parameters& p, bool voltage) {
  constexpr std::string_view by_effort[] = {"stiffness",     "damping",       "integral",      "gear_ratio",
                                            "stall_torque",  "no_load_speed", "max_torque",    "efficiency",
                                            "rotor_inertia", "backlash",      "gear_stiffness"};
  if (voltage) {
    for (const std::string_view name : by_effort)
      if (p.given(name))
        throw Error(quote(name) + " belongs to servos without `part` and `kt`; a motor driven by a voltage has " +
                    "`kt`, `resistance`, `supply_voltage`, `p_gain`, `duty_gain`, `armature` and friction");
    if (p.text("mode") != "position")
      throw Error("`mode` is velocity, but a motor driven by a voltage follows positions (`p_gain`)");
    if (p.text("encoder") != "output") throw Error("`encoder` is motor, but the gear of this motor has no backlash");
    return;
  }
  for (const std::string_view name : amplifier_names)
    if (name != "source" && p.given(name)) throw Error(quote(name) + " belongs to a motor: give `part`, or `kt`");
  for (const std::string_view name : motor_names)
    if (name != "friction" && name != "viscous_friction" && p.given(name))
      throw Error(quote(name) + " belongs to a motor driven by a voltage: give `part`, or `kt` and `resistance`");
}

}  // namespace muro::servo
