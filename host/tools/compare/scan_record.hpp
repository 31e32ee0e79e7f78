// SPDX-License-Identifier: MIT
// A record of a laser scanner that stands still.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace muro::host {

/// The value for a range that a scanner has not reported.
inline constexpr double no_range = std::numeric_limits<double>::quiet_NaN();

struct ScanRecord {
  std::string name;                            ///< name of the file
  std::string scanner;                         ///< its name in the record ("URG-04LX(...)"), or empty
  double range_min = 0, range_max = 0;         ///< m: range that the device can measure; 0: not in the record
  std::vector<double> angles;                  ///< rad, of each beam, counter-clockwise from the front, rising; may be
                                               ///< empty until complete_scans()
  std::vector<std::vector<double>> ranges;     ///< m, [scan][beam]; no_range when there is none
  std::map<std::uint32_t, std::size_t> codes;  ///< counts of error codes, which the device reports instead of a range
  std::vector<std::string> notes;              ///< observations while it was read

  std::size_t beam_count() const { return ranges.empty() ? 0 : ranges.front().size(); }
  /// Ranges outside of these limits (m) become no_range.
  void limit(double least, double most);
};

/// Whether this is a recording of scans: a dialogue in SCIP 2.0, or a table with columns of ranges. False for any other
/// text.
bool is_scan_record(const std::string& text);

/// Reads a dialogue in SCIP 2.0 or a CSV table, depending on its beginning. `name`: for messages. Throws SetupError
/// with file, line and column.
ScanRecord parse_scan_record(const std::string& text, const std::string& name);

}  // namespace muro::host
