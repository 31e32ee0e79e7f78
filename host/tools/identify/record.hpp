// SPDX-License-Identifier: MIT
// A record of a servo that moves a load.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace muro::host {

/// One sample. The command and the supply hold until the next sample.
struct RecordSample {
  double time = 0;            ///< s, rises
  double position = 0;        ///< rad
  double goal = 0;            ///< rad
  double supply_voltage = 0;  ///< V
  bool torque_enable = true;
  double duty = 0;         ///< -1 .. 1, see MotorRecord::has_duty
  double temperature = 0;  ///< degrees Celsius, see MotorRecord::has_temperature
};

/// The load: a pendulum, which hangs down at 0 rad.
struct BenchLoad {
  double mass = 0;      ///< kg, at `length`
  double length = 0;    ///< m, from the axis
  double arm_mass = 0;  ///< kg: of a uniform rod of this length
  double inertia = 0;   ///< kg m^2, in addition to that of mass and arm

  double moment_of_inertia() const { return (mass + arm_mass / 3) * length * length + inertia; }
  /// Largest torque of gravity, N m.
  double gravity_torque() const { return 9.81 * (mass + arm_mass / 2) * length; }
};

struct MotorRecord {
  std::string name;   ///< name of the file
  std::string motor;  ///< its name in the record, or empty
  std::string trajectory;
  double p_gain = 0;      ///< P gain of the firmware, in its units
  double duty_gain = 0;   ///< 1/rad for each unit of the P gain, if it differs from that of the other records; else 0
  double duty_limit = 0;  ///< 0 .. 1, if it differs from that of the other records; else 0
  BenchLoad load;
  bool has_duty = false;
  bool has_temperature = false;
  std::vector<RecordSample> samples;
  std::vector<std::string> notes;  ///< observations while it was read
};

/// Values from the command line for what a record does not give; they have priority.
struct RecordDefaults {
  std::optional<double> p_gain{}, supply_voltage{}, mass{}, length{}, arm_mass{}, inertia{};
  bool commands_only = false;  ///< P gain, supply and load may be missing
};

/// Returns the text of the file. Throws SetupError when it cannot be read, or is larger than any record.
std::string read_record_text(const std::string& file);
/// Reads a CSV file or a JSON file of Rhoban/bam, depending on its beginning. Throws SetupError with file, line and
/// column.
MotorRecord read_motor_record(const std::string& file, const RecordDefaults& defaults);
/// Reads a record from its text. `name`: for messages.
MotorRecord parse_motor_record(const std::string& text, const std::string& name, const RecordDefaults& defaults);

}  // namespace muro::host
