// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/number_text.hpp"

#include <charconv>
#include <cmath>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/fault.hpp"

namespace muro::wire {

void add_number(std::string& out, double number) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void add_seconds(std::string& out, std::int64_t nanoseconds) {
  if (nanoseconds < 0) out += '-';
  const std::uint64_t size = nanoseconds < 0 ? 0 - std::uint64_t(nanoseconds) : std::uint64_t(nanoseconds);
  out += std::to_string(size / 1'000'000'000);
  std::string fraction = std::to_string(size % 1'000'000'000);
  fraction.insert(0, 9 - fraction.size(), '0');
  fraction.erase(fraction.find_last_not_of('0') + 1);
  if (!fraction.empty()) out.append(1, '.').append(fraction);
}

void add_unit(std::string& out, std::string_view unit) {
  for (const char c : unit)
    if (c != ' ' || (!out.empty() && out.back() != ',')) out += c == ' ' ? '*' : c;
}

double read_number(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [used, code] = std::from_chars(digits.data(), end, number);
  if (code == std::errc::result_out_of_range && used == end)
    throw Fault{FaultCode::not_a_number, quote(text) + " does not fit into a number"};
  if (code != std::errc{} || used != end) throw Fault{FaultCode::not_a_number, quote(text) + " is no number"};
  if (!std::isfinite(number)) throw Fault{FaultCode::not_a_number, quote(text) + " is no finite number"};
  return number;
}

void split_fields(std::string_view line, std::vector<std::string_view>& out) {
  constexpr std::string_view blanks = " \t";
  out.clear();
  for (std::size_t begin = line.find_first_not_of(blanks); begin != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

}  // namespace muro::wire
