// SPDX-License-Identifier: MIT
// A scenario run on the commands that were recorded of a real joint.
#pragma once

#include "host/tools/compare/comparison.hpp"
#include "host/tools/identify/motor_simulation.hpp"

namespace muro::host {

/// How far one variation is from one record.
struct RecordDeviation {
  std::string label;    ///< of the variation; empty where nothing is varied
  std::string failure;  ///< why it cannot run or ended early; empty: it ran
  RecordError error;
  Residuals residuals;
  double cost = 0;                 ///< s of wall-clock time by simulated second
  std::vector<std::string> notes;  ///< of readers and defaults of the scenario
  std::vector<std::string>
      record_notes;  ///< how the record was taken: gaps, the velocity at the start, what is left out
};

/// "robot/joint" of the joint to compare: `wanted`, or the only one that moves. Throws SetupError with those there are.
std::string joint_to_compare(Simulation& simulation, const std::string& wanted);

/// Runs the variation from the first sample of the record on. The joint starts there, with the slope of the first
/// recorded positions where they are seen to move. It gets the recorded goals, each until the next (zero-order hold);
/// the supply voltage, the torque's enable and the P gain where its drive takes them (motor.servo). Behind a gap (see
/// PreparedRecord) it starts anew, and nothing is simulated in it. Simulated positions are interpolated between the
/// steps of the motion to the times of the samples.
RecordDeviation run_against(const Comparison& comparison, const Variation& variation, const std::string& joint,
                            const MotorRecord& record, Registry& registry,
                            const std::function<void(LogLevel, std::string_view)>& log);

/// A row for each deviation, those of a record together, with what is to be known of it.
std::string record_table(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);
std::string record_csv(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations);

}  // namespace muro::host
