// SPDX-License-Identifier: MIT
// Scans as a table: lines `# name: value`, a header, and one line for each scan; recorder.csv writes this form too.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "host/tools/compare/scan_text.hpp"

namespace muro::host {

namespace {

std::string_view bare(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t' || s.front() == '"')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r' || s.back() == '"')) s.remove_suffix(1);
  return s;
}

/// Parts of "rover/laser:ranges.measured[17]": its name before the bracket, and 17.
struct RangeColumn {
  std::string_view array;
  std::size_t index = 0;
};

std::optional<RangeColumn> range_column_in(std::string_view cell) {
  const std::size_t open = cell.rfind('[');
  if (open == std::string_view::npos || cell.back() != ']') return std::nullopt;
  const std::string_view array = cell.substr(0, open), index = cell.substr(open + 1, cell.size() - open - 2);
  const std::size_t colon = array.rfind(':');
  const std::string_view property = colon == std::string_view::npos ? array : array.substr(colon + 1);
  if (property != "ranges" && property != "ranges.measured") return std::nullopt;
  RangeColumn c{array};
  const auto [used, code] = std::from_chars(index.data(), index.data() + index.size(), c.index);
  return code == std::errc{} && used == index.data() + index.size() ? std::optional(c) : std::nullopt;
}

/// Returns a number, or no_range for `nan`, `inf` and an empty cell; nothing for any other text.
std::optional<double> range_in(std::string_view text) {
  if (text.empty()) return no_range;
  if (text.front() == '+') text.remove_prefix(1);
  double x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (code != std::errc{} || used != text.data() + text.size()) return std::nullopt;
  return std::isfinite(x) ? x : no_range;
}

class ScanTableReader {
 public:
  ScanTableReader(const std::string& text, const std::string& name) : rest_(text) { record_.name = name; }

  ScanRecord read() {
    if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
    for (number_ = 1; !rest_.empty(); ++number_) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (bare(line).empty()) continue;
      if (bare(line).front() == '#')
        read_constant(line);
      else if (columns_.empty())
        read_header(line);
      else
        read_scan(line);
    }
    finish();
    return std::move(record_);
  }

 private:
  SetupError error(std::size_t column, const std::string& what) const {
    return record_error(record_.name, {number_, column + 1}, what);
  }

  void read_constant(std::string_view line) {
    const std::size_t hash = line.find('#'), colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view name = bare(line.substr(hash + 1, colon - hash - 1)), value = bare(line.substr(colon + 1));
    const bool is_constant = name == "scanner" || name == "unit" || name == "angle_min" || name == "angle_increment" ||
                             name == "range_min" || name == "range_max";
    if (is_constant && !record_.ranges.empty())
      throw error(hash, fmt::format("`{}` stands behind the first scan; what holds for all scans stands before the "
                                    "header",
                                    name));
    if (name == "scanner") record_.scanner = value;
    if (name == "unit") {
      if (value != "m" && value != "mm")
        throw error(colon + 1, fmt::format("`unit` is `{}`; ranges are in `m` or `mm`", value.substr(0, 20)));
      unit_ = value == "m" ? 1 : 1e-3;
    }
    const std::pair<std::string_view, std::optional<double>*> known[] = {{"angle_min", &angle_min_},
                                                                         {"angle_increment", &angle_increment_},
                                                                         {"range_min", &range_min_},
                                                                         {"range_max", &range_max_}};
    for (const auto& [key, to] : known) {
      if (key != name) continue;
      const std::optional<double> x = range_in(value);
      if (!x || !(std::abs(*x) < 1e6))
        throw error(colon + 1, fmt::format("`{}` is `{}`, which is no number", name, value.substr(0, 60)));
      *to = *x;
    }
  }

  template <class Visit>
  void for_each_cell(std::string_view line, const Visit& visit) const {
    const char separator = line.find(';') != std::string_view::npos ? ';' : ',';
    for (std::size_t at = 0;;) {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      visit(at, bare(line.substr(at, end - at)));
      if (end == line.size()) return;
      at = end + 1;
    }
  }

  void read_header(std::string_view line) {
    std::string array;
    for_each_cell(line, [&](std::size_t at, std::string_view cell) {
      const std::optional<RangeColumn> c = range_column_in(cell);
      columns_.push_back(c ? std::optional(c->index) : std::nullopt);
      if (!c) return;
      if (beams_ == 0) array = c->array;
      if (c->array != array)
        throw error(at, fmt::format("there are ranges of `{}` and of `{}`; a record is of one scanner, and of "
                                    "`ranges.measured` or `ranges`",
                                    array, c->array));
      if (c->index != beams_)
        throw error(at,
                    fmt::format("`{}` is expected as [{}]: beams stand in their order", cell.substr(0, 60), beams_));
      ++beams_;
    });
    if (beams_ < 3) throw error(0, "the header has no columns `ranges[0]`, `ranges[1]`, ... for three beams or more");
  }

  void read_scan(std::string_view line) {
    std::vector<double> ranges;
    std::size_t k = 0;
    for_each_cell(line, [&](std::size_t at, std::string_view cell) {
      if (k >= columns_.size())
        throw error(at, fmt::format("there are more cells than the {} columns", columns_.size()));
      if (!columns_[k++]) return;
      const std::optional<double> x = range_in(cell);
      if (!x) throw error(at, fmt::format("`{}` is no range", cell.substr(0, 60)));
      ranges.push_back(*x * unit_);
    });
    if (k < columns_.size())
      throw error(line.size(), fmt::format("there are {} cells for {} columns", k, columns_.size()));
    record_.ranges.push_back(std::move(ranges));
  }

  void finish() {
    if (record_.ranges.empty()) throw SetupError(record_.name + ": there is no scan in it");
    if (angle_min_.has_value() != angle_increment_.has_value())
      throw SetupError(record_.name + ": `# angle_min: ...` and `# angle_increment: ...` (rad) belong together");
    if (angle_increment_ && !(*angle_increment_ > 0 && *angle_increment_ < 1))
      throw SetupError(fmt::format("{}: `angle_increment` is {:g} rad, and is above 0 and below 1", record_.name,
                                   *angle_increment_));
    for (std::size_t i = 0; angle_min_ && i < beams_; ++i)
      record_.angles.push_back(*angle_min_ + double(i) * *angle_increment_);
    record_.range_min = range_min_.value_or(0), record_.range_max = range_max_.value_or(0);
    if (record_.range_max != 0 && record_.range_max <= record_.range_min)
      throw SetupError(fmt::format("{}: `range_max` is {:g} m, and is above `range_min`, {:g} m", record_.name,
                                   record_.range_max, record_.range_min));
    constexpr double open_end = 1e6, just = 1e-9;  // m; a reading of range_max means that nothing was seen
    record_.limit(std::max(record_.range_min, just), record_.range_max > 0 ? record_.range_max - just : open_end);
  }

  std::string_view rest_;
  std::size_t number_ = 1;
  ScanRecord record_;
  std::vector<std::optional<std::size_t>> columns_;  ///< index of the beam, for columns of beams
  std::size_t beams_ = 0;
  double unit_ = 1;
  std::optional<double> angle_min_{}, angle_increment_{}, range_min_{}, range_max_{};
};

}  // namespace

ScanRecord parse_csv_scans(const std::string& text, const std::string& name) {
  return ScanTableReader(text, name).read();
}

}  // namespace muro::host
