// SPDX-License-Identifier: MIT
#include "part_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

constexpr std::size_t largest_part_file = std::size_t(1) << 20;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

/// Returns a finite number, or nothing.
std::optional<double> number_in(std::string_view text) {
  double x = 0;
  const char* const end = text.data() + text.size();
  const auto [used, code] = std::from_chars(text.data(), end, x);
  if (code != std::errc{} || used != end || !std::isfinite(x)) return std::nullopt;
  return x;
}

/// One line, read from the left.
struct PartLine {
  std::string_view text;
  std::size_t at = 0;

  bool at_end() const { return at >= text.size() || text[at] == '#'; }
  void skip_blanks() {
    while (at < text.size() && text[at] == ' ') ++at;
  }
  std::string_view name() {
    const std::size_t from = at;
    while (at < text.size() && is_name_character(text[at])) ++at;
    return text.substr(from, at - from);
  }
  /// Reads a value, in quotes or up to the comment. Returns false if a quote is not closed.
  bool value(std::string& to) {
    if (text[at] == '"') {
      const std::size_t end = text.find('"', at + 1);
      if (end == std::string_view::npos) return false;
      to = text.substr(at + 1, end - at - 1);
      at = end + 1;
      return true;
    }
    std::size_t end = at;
    while (end < text.size() && !(text[end] == '#' && text[end - 1] == ' ')) ++end;
    at = end;
    to = text.substr(0, end).substr(std::min(end, text.find_first_not_of(' ', text.find(':') + 1)));
    while (!to.empty() && to.back() == ' ') to.pop_back();
    return true;
  }
};

}  // namespace

PartFile PartFile::parse(std::string_view text, std::string name) {
  PartFile file;
  file.name_ = std::move(name);
  std::string section;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    PartLine line{text.substr(0, end)};
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.text.empty() && line.text.back() == '\r') line.text.remove_suffix(1);
    const auto fail = [&](const std::string& what) -> Error {
      return Error(file.name_ + ":" + std::to_string(number) + ":" + std::to_string(line.at + 1) + ": " + what);
    };
    line.skip_blanks();
    if (line.at_end()) continue;
    const std::size_t indent = line.at;
    const std::string key(line.name());
    if (key.empty()) throw fail("a line of a part file is `name: value` or `section:`");
    if (line.at >= line.text.size() || line.text[line.at] != ':') throw fail("a `:` is missing after " + quote(key));
    ++line.at;
    line.skip_blanks();
    if (line.at_end()) {
      if (indent > 0) throw fail(quote(key) + " has no value; only lines that are not indented open a section");
      section = key;
      continue;
    }
    if (indent == 0) section.clear();
    std::string value;
    const int column = int(line.at) + 1;
    if (!line.value(value)) throw fail("the quote is not closed");
    line.skip_blanks();
    if (!line.at_end()) throw fail("there is more after the value of " + quote(key));
    if (const Entry* const other = file.find(section, key))
      throw fail(quote(key) + " stands in line " + std::to_string(other->line) + " already");
    file.entries_.push_back({section, key, value, number, column, int(indent) + 1});
  }
  return file;
}

PartFile PartFile::read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(largest_part_file + 1, '\0');
  in.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(std::max<std::streamsize>(in.gcount(), 0)));
  if (in.bad() || (text.empty() && !in.eof())) throw Error("part file " + quote(path) + " cannot be read");
  if (text.size() > largest_part_file) throw Error("part file " + quote(path) + " is larger than 1 MiB");
  return parse(text, path);
}

std::vector<std::string> PartFile::sections() const {
  std::vector<std::string> names;
  for (const Entry& e : entries_)
    if (!e.section.empty() && (names.empty() || names.back() != e.section)) names.push_back(e.section);
  return names;
}

const PartFile::Entry* PartFile::find(std::string_view section, std::string_view name) const {
  for (const Entry& e : entries_)
    if (e.section == section && e.name == name) return &e;
  return nullptr;
}

std::optional<double> PartFile::number(std::string_view section, std::string_view name) const {
  const Entry* const entry = find(section, name);
  if (!entry) return std::nullopt;
  const std::optional<double> x = number_in(entry->value);
  if (!x) throw Error(place(*entry) + quote(name) + " is " + quote(entry->value) + ", which is no number");
  return x;
}

std::vector<double> PartFile::numbers(const Entry& entry) const {
  std::string_view rest = entry.value;
  const bool is_list = !rest.empty() && rest.front() == '[';
  if (is_list && rest.back() != ']') throw Error(place(entry) + "`]` is missing: a list of numbers stands in one line");
  if (is_list) rest = rest.substr(1, rest.size() - 2);
  std::vector<double> all;
  while (true) {
    const std::size_t end = is_list ? std::min(rest.find(','), rest.size()) : rest.size();
    std::string_view item = rest.substr(0, end);
    while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
    while (!item.empty() && item.back() == ' ') item.remove_suffix(1);
    const std::optional<double> x = number_in(item);
    if (!x) throw Error(place(entry) + quote(entry.name) + " is " + quote(item) + ", which is no number");
    all.push_back(*x);
    if (end == rest.size()) return all;
    rest.remove_prefix(end + 1);
  }
}

std::string PartFile::place(const Entry& entry) const {
  return name_ + ":" + std::to_string(entry.line) + ":" + std::to_string(entry.column) + ": ";
}

std::string PartFile::place_of_name(const Entry& entry) const {
  return name_ + ":" + std::to_string(entry.line) + ":" + std::to_string(entry.name_column) + ": ";
}

void PartFile::check_names(std::string_view section, std::span<const std::string_view> known) const {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const Entry& e : entries_)
    if (e.section == section && std::find(known.begin(), known.end(), e.name) == known.end())
      throw Error(place_of_name(e) + "there is no parameter " + quote(e.name) + did_you_mean(e.name, names) +
                  "; here stand: " + quoted_list(known));
}

PartFile find_part(std::string_view name, const std::string& path, std::span<const ReadyPart> ready) {
  std::vector<std::string> names;
  for (const ReadyPart& part : ready) {
    if (part.name == name) return PartFile::parse(part.text, std::string(name));
    names.emplace_back(part.name);
  }
  if (name.find('/') != std::string_view::npos || name.find('.') != std::string_view::npos) return PartFile::read(path);
  throw Error("there is no part " + quote(name) + did_you_mean(name, names) + "; ready are " + quoted_list(names) +
              ", and a file of your own is given by its path, such as my_part.yaml");
}

}  // namespace muro
