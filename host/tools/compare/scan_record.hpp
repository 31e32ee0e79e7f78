// SPDX-License-Identifier: MIT
// What was recorded of a laser scanner that stands still.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace muro::host {

/// What stands in the place of a range where a scanner has told none.
inline constexpr double no_range = std::numeric_limits<double>::quiet_NaN();

struct ScanRecord {
  std::string name;                            ///< of the file
  std::string scanner;                         ///< as the record calls it ("URG-04LX(...)"), or empty
  double range_min = 0, range_max = 0;         ///< m: what the device can measure; 0: the record does not say it
  std::vector<double> angles;                  ///< rad, of each beam, counter-clockwise from the front, rising; may be
                                               ///< empty until complete_scans()
  std::vector<std::vector<double>> ranges;     ///< m, [scan][beam]; no_range where there is none
  std::map<std::uint32_t, std::size_t> codes;  ///< of errors, as the device tells them instead of a range: how often
  std::vector<std::string> notes;              ///< what was noticed when it was read

  std::size_t beam_count() const { return ranges.empty() ? 0 : ranges.front().size(); }
  /// Ranges outside of these limits (m) become no_range.
  void limit(double least, double most);
};

/// Whether this is a recording of scans: a dialogue in SCIP 2.0, or a table with columns of ranges. What else it may
/// be, it is not this.
bool is_scan_record(const std::string& text);

/// Reads a dialogue in SCIP 2.0 or a CSV table, by what it begins with. `name`: for messages. Throws SetupError, with
/// file, line and column.
ScanRecord parse_scan_record(const std::string& text, const std::string& name);

}  // namespace muro::host
