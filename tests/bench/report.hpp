// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace muro::bench {

/// A field of a table: a text, a whole number (printed in groups of three digits) or a real one.
using Cell = nlohmann::ordered_json;

/// `number` with so many digits after the point.
inline double fixed(double number, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(number * scale) / scale;
}
inline std::int64_t whole(double number) { return std::llround(number); }
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// What a benchmark found: ratios, which are the result, and the tables they come from. Printed as Markdown; with
/// `--json FILE` also merged into that file, beside what other programs put there, and the whole is written again as
/// Markdown beside it.
class Report {
 public:
  /// `name` without "bench_". Arguments but --json are left for the program.
  Report(const std::string& name, const std::string& title, int argc, char** argv);

  /// The value of `--NAME VALUE`, or `default_value`.
  std::string argument(const std::string& name, const std::string& default_value) const;

  /// A table that takes the rows from here on.
  void table(const std::string& title, const std::vector<std::string>& columns);
  void row(const std::vector<Cell>& cells);
  /// `target`: what the project aims at, e.g. "at least 12".
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
