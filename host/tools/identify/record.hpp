// SPDX-License-Identifier: MIT
// What was recorded of a servo that moves a load.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace muro::host {

/// The command and the supply hold until the next sample.
struct RecordSample {
  double time = 0;            ///< s, grows
  double position = 0;        ///< rad
  double goal = 0;            ///< rad
  double supply_voltage = 0;  ///< V
  bool torque_enable = true;
  double duty = 0;         ///< -1 .. 1, see MotorRecord::has_duty
  double temperature = 0;  ///< degrees Celsius, see MotorRecord::has_temperature
};

/// The load: a pendulum. At 0 rad it hangs down.
struct BenchLoad {
  double mass = 0;      ///< kg, at `length`
  double length = 0;    ///< m, from the axis
  double arm_mass = 0;  ///< kg: of an even rod of this length
  double inertia = 0;   ///< kg m^2, beside that of mass and arm

  double moment_of_inertia() const { return (mass + arm_mass / 3) * length * length + inertia; }
  /// N m: the largest one.
  double gravity_torque() const { return 9.81 * (mass + arm_mass / 2) * length; }
};

struct MotorRecord {
  std::string name;   ///< of the file
  std::string motor;  ///< as the record calls it, or empty
  std::string trajectory;
  double p_gain = 0;      ///< of the firmware, in its units
  double duty_gain = 0;   ///< 1/rad for each unit of the P gain, where it is not that of the other records; else 0
  double duty_limit = 0;  ///< 0 .. 1, likewise
  BenchLoad load;
  bool has_duty = false;
  bool has_temperature = false;
  std::vector<RecordSample> samples;
  std::vector<std::string> notes;  ///< what was noticed when it was read
};

/// What a record does not say itself, by the command line; it takes precedence.
struct RecordDefaults {
  std::optional<double> p_gain{}, supply_voltage{}, mass{}, length{}, arm_mass{}, inertia{};
  bool commands_only = false;  ///< P gain, supply and load may be missing
};

/// What is in the file; throws SetupError where it cannot be read, or is larger than any record.
std::string read_record_text(const std::string& file);
/// Reads a CSV file or a JSON file of Rhoban/bam, by what it begins with. Throws SetupError, with file, line and
/// column.
MotorRecord read_motor_record(const std::string& file, const RecordDefaults& defaults);
/// The same of a text. `name`: for messages.
MotorRecord parse_motor_record(const std::string& text, const std::string& name, const RecordDefaults& defaults);

}  // namespace muro::host
