// SPDX-License-Identifier: MIT
#include "host/tools/compare/scan_record.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/tools/compare/scan_text.hpp"

namespace muro::host {

namespace {

/// Returns the first line that is no comment and not empty.
std::string_view first_line(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string_view::npos && line[begin] != '#') return line.substr(begin);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

/// Whether a measuring command or the model is among the first lines: a recording may begin in the middle of a reply.
bool has_scip_command(std::string_view text) {
  constexpr int first_lines = 100;
  const auto is_command = [](std::string_view line) {
    const std::string_view digits = line.substr(0, line.find_first_of(";\r"));
    const bool measures = digits.size() >= 12 && digits.size() <= 15 && (digits[0] == 'M' || digits[0] == 'G') &&
                          std::string_view("DSE").find(digits[1]) != std::string_view::npos &&
                          digits.find_first_not_of("0123456789", 2) == std::string_view::npos;
    return measures || line.starts_with("MODL:");
  };
  for (int i = 0; i < first_lines && !text.empty(); ++i) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (is_command(text.substr(0, end))) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

bool is_scip(std::string_view text) {
  const std::string_view line = first_line(text);
  if (line.find(',') != std::string_view::npos && line.find('[') != std::string_view::npos) return false;
  for (const std::string_view begin :
       {"GD", "GS", "GE", "MD", "MS", "ME", "VV", "PP", "II", "BM", "QT", "RS", "SCIP2.0", "VEND:", "MODL:"})
    if (line.starts_with(begin)) return true;
  return has_scip_command(text);
}

}  // namespace

void ScanRecord::limit(double least, double most) {
  for (std::vector<double>& scan : ranges)
    for (double& r : scan)
      if (!(r >= least && r <= most)) r = no_range;
}

bool is_scan_record(const std::string& text) {
  return is_scip(text) || first_line(text).find("ranges") != std::string_view::npos;
}

ScanRecord parse_scan_record(const std::string& text, const std::string& name) {
  return is_scip(text) ? parse_scip_record(text, name) : parse_csv_scans(text, name);
}

}  // namespace muro::host
