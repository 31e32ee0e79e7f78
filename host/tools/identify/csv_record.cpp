// SPDX-License-Identifier: MIT
// Records as tables: lines `# name: value`, a header with the names of columns, one line for each sample.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "host/names.hpp"
#include "host/tools/identify/record_text.hpp"

namespace muro::host {

namespace {

enum Column {
  time_column,
  position_column,
  goal_column,
  supply_column,
  enable_column,
  duty_column,
  temperature_column,
  column_count
};

struct ColumnName {
  std::string_view name;
  Column column;
};
constexpr ColumnName column_names[] = {
    {"time", time_column},          {"timestamp", time_column},
    {"position", position_column},  {"goal", goal_column},
    {"goal_position", goal_column}, {"supply_voltage", supply_column},
    {"input_volts", supply_column}, {"torque_enable", enable_column},
    {"duty", duty_column},          {"temperature", temperature_column},
    {"temp", temperature_column},
};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t' || s.front() == '"')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r' || s.back() == '"')) s.remove_suffix(1);
  return s;
}

std::optional<double> number_in(std::string_view text) {
  double x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (code != std::errc{} || used != text.data() + text.size() || !std::isfinite(x) || std::abs(x) > 1e12)
    return std::nullopt;
  return x;
}

class CsvReader {
 public:
  CsvReader(const std::string& text, const std::string& name) : text_(text) { record_.name = name; }

  MotorRecord read(const RecordDefaults& defaults) {
    std::string_view rest = text_;
    if (rest.substr(0, 3) == "\xef\xbb\xbf") rest.remove_prefix(3);
    for (line_ = 1; !rest.empty(); ++line_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (trimmed(line).empty()) continue;
      if (trimmed(line).front() == '#')
        read_constant(line);
      else if (columns_.empty())
        read_header(line);
      else
        read_sample(line);
    }
    if (columns_.empty()) throw record_error(record_.name, {line_, 1}, "there is no header with the names of columns");
    complete_record(record_, defaults, places_);
    return record_;
  }

 private:
  SetupError error(std::size_t column, const std::string& what) const {
    return record_error(record_.name, {line_, column + 1}, what);
  }

  /// Reads `# name: value`; other comments have no meaning.
  void read_constant(std::string_view line) {
    const std::size_t hash = line.find('#'), colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view name = trimmed(line.substr(hash + 1, colon - hash - 1)),
                           value = trimmed(line.substr(colon + 1));
    const std::pair<std::string_view, double*> known[] = {
        {"p_gain", &record_.p_gain},          {"supply_voltage", &supply_},        {"mass", &record_.load.mass},
        {"duty_gain", &record_.duty_gain},    {"duty_limit", &record_.duty_limit}, {"length", &record_.load.length},
        {"arm_mass", &record_.load.arm_mass}, {"inertia", &record_.load.inertia}};
    for (const auto& [key, to] : known) {
      if (key != name) continue;
      const std::optional<double> x = number_in(value);
      if (!x) throw error(colon + 1, fmt::format("`{}` is `{}`, which is no number", name, value.substr(0, 60)));
      *to = *x;
    }
    if (name == "motor") record_.motor = value;
    if (name == "trajectory") record_.trajectory = value;
  }

  template <class Visit>
  void for_each_cell(std::string_view line, const Visit& visit) const {
    const char separator = line.find(';') != std::string_view::npos    ? ';'
                           : line.find('\t') != std::string_view::npos ? '\t'
                                                                       : ',';
    for (std::size_t k = 0, at = 0;; ++k) {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      visit(k, at, trimmed(line.substr(at, end - at)));
      if (end == line.size()) return;
      at = end + 1;
    }
  }

  void read_header(std::string_view line) {
    std::vector<bool> seen(column_count);
    for_each_cell(line, [&](std::size_t, std::size_t at, std::string_view cell) {
      int found = -1;
      for (const ColumnName& c : column_names)
        if (c.name == cell) found = c.column;
      if (found >= 0 && seen[std::size_t(found)])
        throw error(at, fmt::format("there is a second column for `{}`", cell));
      if (found >= 0) seen[std::size_t(found)] = true;
      columns_.push_back(found);
    });
    const std::pair<Column, const char*> needed[] = {
        {time_column, "time"}, {position_column, "position"}, {goal_column, "goal"}};
    for (const auto& [column, name] : needed)
      if (!seen[std::size_t(column)])
        throw error(0,
                    fmt::format("the header has no column `{}`; a record has `time` (s), `position` (rad) and `goal` "
                                "(rad), and may have `supply_voltage` (V), `torque_enable`, `duty` and "
                                "`temperature` (degrees Celsius)",
                                name));
    record_.has_duty = seen[duty_column];
    record_.has_temperature = seen[temperature_column];
  }

  void read_sample(std::string_view line) {
    RecordSample s;
    s.supply_voltage = supply_;
    std::size_t cells = 0;
    for_each_cell(line, [&](std::size_t k, std::size_t at, std::string_view cell) {
      ++cells;
      if (k >= columns_.size())
        throw error(at, fmt::format("there are more cells than the {} columns", columns_.size()));
      if (columns_[k] < 0) return;
      const std::optional<double> x = number_in(cell == "true" ? "1" : cell == "false" ? "0" : cell);
      if (!x) throw error(at, fmt::format("`{}` is no number", cell.substr(0, 60)));
      switch (Column(columns_[k])) {
        case time_column:
          s.time = *x;
          break;
        case position_column:
          s.position = *x;
          break;
        case goal_column:
          s.goal = *x;
          break;
        case supply_column:
          s.supply_voltage = *x;
          break;
        case enable_column:
          s.torque_enable = *x != 0;
          break;
        case duty_column:
          s.duty = *x;
          break;
        case temperature_column:
          s.temperature = *x;
          break;
        case column_count:
          break;
      }
    });
    if (cells < columns_.size())
      throw error(line.size(), fmt::format("there are {} cells for {} columns", cells, columns_.size()));
    record_.samples.push_back(s);
    places_.push_back({line_, 1});
  }

  const std::string& text_;
  MotorRecord record_;
  double supply_ = 0;
  std::size_t line_ = 1;
  std::vector<int> columns_;  ///< the quantity of each column, or -1
  std::vector<TextPlace> places_;
};

}  // namespace

MotorRecord parse_csv_record(const std::string& text, const std::string& name, const RecordDefaults& defaults) {
  return CsvReader(text, name).read(defaults);
}

}  // namespace muro::host
