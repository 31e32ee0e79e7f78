// SPDX-License-Identifier: MIT
// Runs of a scenario on the commands that were recorded from a real joint.
#pragma once

#include "host/tools/compare/comparison.hpp"
#include "host/tools/identify/motor_simulation.hpp"

namespace muro::host {

/// Deviation of one variation from one record.
struct RecordDeviation {
  std::string label;    ///< label of the variation; empty when nothing is varied
  std::string failure;  ///< reason why it cannot run or ended early; empty: it ran to its end
  RecordError error;
  Residuals residuals;
  double cost = 0;                        ///< s of wall-clock time per simulated second
  std::vector<std::string> notes;         ///< notes of readers and defaults of the scenario
  std::vector<std::string> record_notes;  ///< notes on the record: gaps, the velocity at the start, omitted parts
};

/// Returns "robot/joint" of the joint to compare: `wanted`, or the only movable one. Throws SetupError with all joints.
std::string joint_to_compare(Simulation& simulation, const std::string& wanted);

/// Runs the variation from the first sample of the record on. The joint starts there, with the slope of the first
/// recorded positions if they show a motion. It gets the recorded goals, each until the next one (zero-order hold), and
/// also the supply voltage, the torque's enable and the P gain if its drive takes them (motor.servo). After a gap (see
/// PreparedRecord) it starts anew; nothing is simulated during the gap. Simulated positions are interpolated between
/// the steps of the motion to the times of the samples.
RecordDeviation run_against(const Comparison& comparison, const Variation& variation, const std::string& joint,
                            const MotorRecord& record, Registry& registry,
                            const std::function<void(LogLevel, std::string_view)>& log);

/// Returns a table with a row for each deviation, grouped by record, with the notes on each record.
std::string record_table(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);
std::string record_csv(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);

}  // namespace muro::host
