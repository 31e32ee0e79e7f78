// SPDX-License-Identifier: MIT
// A scenario's laser scanner beside scans that were recorded of a real one.
#pragma once

#include "host/tools/compare/comparison.hpp"
#include "host/tools/compare/scan_statistics.hpp"

namespace muro::host {

/// A scanner of a built simulation, at one of its variations.
struct SimulatedScans {
  std::string label;                ///< of the variation; empty where nothing is varied
  std::string failure;              ///< why it cannot run or ended early; empty: it ran
  ScanRecord scans;                 ///< as the simulated device reads them
  std::vector<double> true_ranges;  ///< m, of each beam, at the end
  std::vector<std::string> notes;
};

/// "robot/laser" of the scanner to compare: `wanted`, or the only one. Throws SetupError with those there are.
std::string scanner_to_compare(const Simulation& simulation, const std::string& wanted);

/// Runs the variation until `count` scans have been taken, each with the errors of its sensor.error.
SimulatedScans simulate_scans(const Comparison& comparison, const Variation& variation, const std::string& sensor,
                              std::size_t count, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// A record beside a variation.
struct ScanDeviation {
  std::string label, failure;
  ScanStatistics simulated;
  ScanStatistics recorded;  ///< with its bias against the true ranges of this variation, where the map is known
};

/// What the record does not say of directions and limits is taken from the simulated scanner, and told in the record's
/// notes. Throws SetupError where the number of beams does not fit either.
void complete_scans(ScanRecord& record, const ScanRecord& simulated);

/// `known_map`: the scene is the room of the record, and the scanner stands where it was recorded.
ScanDeviation deviation_of(const ScanRecord& record, const SimulatedScans& simulated, bool known_map);

/// The deviations of one record, as tables.
std::string scan_table(const ScanRecord& record, const std::vector<ScanDeviation>& deviations);
/// A row for each quantity, source and band of all records.
std::string scan_csv(const std::vector<ScanRecord>& records, const std::vector<ScanDeviation>& deviations);
/// Noise over range (SVG): of the record, of each variation, and what the data sheet says.
std::string scan_picture(const ScanRecord& record, const std::vector<ScanDeviation>& deviations);

}  // namespace muro::host
