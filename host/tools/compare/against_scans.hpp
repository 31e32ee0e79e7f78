// SPDX-License-Identifier: MIT
// Comparison of a scenario's laser scanner with scans that were recorded from a real one.
#pragma once

#include "host/tools/compare/comparison.hpp"
#include "host/tools/compare/scan_statistics.hpp"

namespace muro::host {

/// Scans of a scanner in a built simulation, for one of its variations.
struct SimulatedScans {
  std::string label;                ///< label of the variation; empty when nothing is varied
  std::string failure;              ///< reason why it cannot run or ended early; empty: it ran to its end
  ScanRecord scans;                 ///< as the simulated device reads them
  std::vector<double> true_ranges;  ///< m, for each beam, at the end
  std::vector<std::string> notes;
};

/// Returns "robot/laser" of the scanner to compare: `wanted`, or the only one. Throws SetupError with all scanners.
std::string scanner_to_compare(const Simulation& simulation, const std::string& wanted);

/// Runs the variation until `count` scans have been taken, each with the errors of its sensor.error.
SimulatedScans simulate_scans(const Comparison& comparison, const Variation& variation, const std::string& sensor,
                              std::size_t count, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// Comparison of a record with a variation.
struct ScanDeviation {
  std::string label, failure;
  ScanStatistics simulated;
  ScanStatistics recorded;  ///< with its bias from the true ranges of this variation, if the map is known
};

/// Takes missing directions and limits of the record from the simulated scanner, and reports that in the record's
/// notes. Throws SetupError when the number of beams does not fit either.
void complete_scans(ScanRecord& record, const ScanRecord& simulated);

/// Compares a record with a variation. `known_map`: the scene is the recorded room, with the scanner at its place.
ScanDeviation deviation_of(const ScanRecord& record, const SimulatedScans& simulated, bool known_map);

/// Returns the deviations of one record, as tables.
std::string scan_table(const ScanRecord& record, const std::vector<ScanDeviation>& deviations);
/// Returns a row for each quantity, source and band of all records.
std::string scan_csv(const std::vector<ScanRecord>& records, const std::vector<ScanDeviation>& deviations);
/// Returns noise over range (SVG): of the record, of each variation, and as in the data sheet.
std::string scan_picture(const ScanRecord& record, const std::vector<ScanDeviation>& deviations);

}  // namespace muro::host
