// SPDX-License-Identifier: MIT
// A scenario run on the commands that were recorded of a real joint.
#pragma once

#include "host/compare/comparison.hpp"
#include "host/identify/motor_simulation.hpp"

namespace muro::host {

/// How far one variation is from one record.
struct RecordDeviation {
  std::string label;    ///< of the variation; empty where nothing is varied
  std::string failure;  ///< why it cannot run or ended early; empty: it ran
  RecordError error;
  Residuals residuals;
  double cost = 0;  ///< s of wall-clock time by simulated second
  std::vector<std::string> notes;
};

/// "robot/joint" of the joint to compare: `wanted`, or the only one that moves. Throws SetupError with those there are.
std::string joint_to_compare(Simulation& simulation, const std::string& wanted);

/// Runs the variation from the first sample of the record on. The joint starts there, at rest, and gets the recorded
/// goals; the supply voltage, the torque's enable and the P gain where its drive takes them (motor.servo).
RecordDeviation run_against(const Comparison& comparison, const Variation& variation, const std::string& joint,
                            const MotorRecord& record, Registry& registry,
                            const std::function<void(LogLevel, std::string_view)>& log);

/// A row for each deviation, those of a record together.
std::string record_table(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);
std::string record_csv(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);

}  // namespace muro::host
