// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace muro::bench {

/// A field of a table: a text, a whole number (printed in groups of three digits) or a real number.
using Cell = nlohmann::ordered_json;

/// Rounds to a number of digits after the point.
inline double fixed(double number, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(number * scale) / scale;
}
inline std::int64_t whole(double number) { return std::llround(number); }
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Results of a benchmark: the ratios, and the tables that they come from. It prints them as Markdown. With `--json
/// FILE` it also merges them into that file, which several programs share, and writes the whole file as Markdown beside
/// it.
class Report {
 public:
  /// `name`: without "bench_". The program reads all arguments except --json.
  Report(const std::string& name, const std::string& title, int argc, char** argv);

  /// Returns the value of `--NAME VALUE`, or `default_value`.
  std::string argument(const std::string& name, const std::string& default_value) const;

  /// Begins a table, to which the next rows are added.
  void table(const std::string& title, const std::vector<std::string>& columns);
  void row(const std::vector<Cell>& cells);
  /// `target`: goal of the project, e.g. "at least 12".
  void ratio(const std::string& what, double value, const std::string& target = "");
  void note(const std::string& text) { found_["notes"].push_back(text); }
  /// Prints the ratios and notes and writes the file.
  void finish();

 private:
  std::string name_, file_;
  std::vector<std::string> arguments_;
  nlohmann::ordered_json found_;
};

}  // namespace muro::bench
