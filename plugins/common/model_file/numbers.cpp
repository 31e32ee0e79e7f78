// SPDX-License-Identifier: MIT
#include "numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "message.hpp"

namespace muro::model_file {

namespace {

/// Returns one number; sets `error` on failure.
double parse_number(std::string_view word, std::string& error) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool complete = end == word.data() + word.size();
  if (code == std::errc::result_out_of_range && complete) {
    // a number too small for a double is zero
    long double extended = 1;
    std::from_chars(word.data(), word.data() + word.size(), extended);
    if (std::abs(extended) >= 1) error = "is out of the range of a number; the largest is 1.8e308";
  } else if (code != std::errc() || !complete) {
    error = word.find(',') != word.npos ? "is no number; the decimal sign is a point, and blanks separate numbers"
                                        : "is no number; write it like 0.05 or 5e-2";
  } else if (!std::isfinite(value)) {
    error = "is not finite";
  }
  return value;
}

}  // namespace

std::vector<double> parse_numbers(std::string_view text, std::string& error) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<double> values;
  std::size_t begin = 0;
  while ((begin = text.find_first_not_of(blanks, begin)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    const double value = parse_number(text.substr(begin, end - begin), error);
    if (!error.empty()) return {};
    values.push_back(value);
    begin = end;
  }
  return values;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count, std::string& error) {
  std::vector<double> values = parse_numbers(text, error);
  if (error.empty() && values.size() != count)
    error = concat("has ", values.size(), values.size() == 1 ? " number" : " numbers", ", and needs ", count,
                   count == 1 ? "" : " separated by blanks");
  if (!error.empty()) return std::nullopt;
  return values;
}

std::string text_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double v : numbers) text += (text.empty() ? "" : " ") + shortest(v);
  return text;
}

}  // namespace muro::model_file
