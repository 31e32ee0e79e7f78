// SPDX-License-Identifier: MIT
#include "core/error.hpp"

#include <algorithm>

#include "muro/base/printable.hpp"

namespace muro {

namespace {

constexpr std::size_t longest_quotation = 512;  // bytes; most paths are shorter
constexpr std::size_t most_lines = 250;

std::string with_short_quotations(std::string_view line) {
  std::string cut;
  bool quoted = false;
  for (std::size_t end = 0; end != line.npos; quoted = !quoted) {
    end = line.find('`');
    const std::string_view part = line.substr(0, end);
    cut += quoted ? shortened(part, longest_quotation) : std::string(part);
    if (end == line.npos) break;
    cut += '`';
    line.remove_prefix(end + 1);
  }
  return cut;
}

}  // namespace

std::string message_text(std::string_view text) {
  const std::string shown = printable(text, "\n");
  const auto all = std::size_t(std::count(shown.begin(), shown.end(), '\n')) + 1;
  std::string_view rest = shown;
  std::string cut;
  for (std::size_t line = 0; line < all; ++line) {
    if (line == most_lines && all > most_lines + 1) return cut + "and " + std::to_string(all - line) + " lines more";
    const std::string_view whole = rest.substr(0, rest.find('\n'));
    cut += with_short_quotations(whole);
    rest.remove_prefix(std::min(whole.size() + 1, rest.size()));
    if (line + 1 < all) cut += '\n';
  }
  return cut;
}

std::string in_backquotes(std::string_view name) { return "`" + shortened(printable(name), longest_quotation) + "`"; }

}  // namespace muro
