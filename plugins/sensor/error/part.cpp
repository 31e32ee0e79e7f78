// SPDX-License-Identifier: MIT
#include "part.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "muro/algorithm.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

constexpr std::string_view blanks = " \t";

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::string number_text(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

/// What a parameter allows, for messages.
std::string allowed(const Parameter& p) {
  if (!p.choices.empty()) return "one of " + quoted_list(p.choices);
  std::string text = p.type == ParameterType::reals     ? "numbers"
                     : p.type == ParameterType::integer ? "a whole number"
                                                        : "a number";
  if (p.type == ParameterType::reals && p.length > 0) text = std::to_string(p.length) + " numbers";
  if (std::isfinite(p.min) && std::isfinite(p.max)) text += " from " + number_text(p.min) + " to " + number_text(p.max);
  return text;
}

/// Reads the lines of a part one by one.
class PartReader {
 public:
  PartReader(const std::string& file, std::span<const Parameter> parameters) : parameters_(parameters) {
    part_.file = file;
  }

  Part read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      read_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (part_.sections.empty())
      fail(1, "there is no section; a part has one for each of its readings, such as `gyro:`");
    close_section();
    return std::move(part_);
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& what) const { fail(line_, column, what); }
  [[noreturn]] void fail(int line, std::size_t column, const std::string& what) const {
    throw Error(part_.file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
  }

  void read_line(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    for (std::size_t i = 0; i < line.size(); ++i)
      if (line[i] == '#' && (i == 0 || blanks.find(line[i - 1]) != std::string_view::npos)) line = line.substr(0, i);
    if (without_blanks(line).empty()) return;
    const std::size_t begin = line.find_first_not_of(' ');
    if (line[begin] == '\t') fail(begin + 1, "a tab; YAML indents by blanks");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
      fail(begin + 1, quote(without_blanks(line)) + " is neither `SECTION:` nor `NAME: VALUE`");
    const std::string_view name = without_blanks(line.substr(0, colon));
    const std::string_view value = without_blanks(line.substr(colon + 1));
    const std::size_t value_column = value.empty() ? colon + 2 : std::size_t(value.data() - line.data()) + 1;
    if (begin == 0)
      open_section(name, value, value_column);
    else
      add_value(name, begin + 1, value, value_column);
  }

  void open_section(std::string_view name, std::string_view value, std::size_t value_column) {
    if (!value.empty())
      fail(value_column,
           quote(value) + " follows the name of a section; its values stand in the lines below it, indented");
    close_section();
    for (const PartSection& s : part_.sections)
      if (s.name == name) fail(1, "section " + quote(name) + " is there already, in line " + std::to_string(s.line));
    part_.sections.push_back({std::string(name), "", line_, {}});
    indentation_ = 0;
  }

  /// What can be told only at the end of a section.
  void close_section() const {
    if (part_.sections.empty()) return;
    const PartSection& last = part_.sections.back();
    if (last.reading.empty())
      fail(last.line, 1,
           "section " + quote(last.name) +
               " has no `reading`: the property whose errors it has, such as "
               "`reading: angular_velocity`");
    for (const PartSection& s : part_.sections)
      if (&s != &last && s.reading == last.reading)
        fail(last.line, 1,
             "sections " + quote(s.name) + " and " + quote(last.name) + " are both of " + quote(s.reading));
  }

  void add_value(std::string_view name, std::size_t column, std::string_view value, std::size_t value_column) {
    if (part_.sections.empty()) fail(column, quote(name) + " stands before the first section, such as `gyro:`");
    if (indentation_ == 0) indentation_ = column;
    if (column != indentation_)
      fail(column, quote(name) +
                       " is indented in another way than the lines above it; a part has sections and values, "
                       "and nothing below these");
    if (value.empty()) fail(value_column, quote(name) + " has no value");
    PartSection& section = part_.sections.back();
    if (name == "reading") {
      if (!section.reading.empty()) fail(column, "`reading` is given twice");
      section.reading = value;
      return;
    }
    PartValue read = parse_value(value, value_column);
    check(parameter(name, column), read);
    if (!section.values.emplace(name, std::move(read)).second) fail(column, quote(name) + " is given twice");
  }

  const Parameter& parameter(std::string_view name, std::size_t column) const {
    std::vector<std::string> names;
    for (const Parameter& p : parameters_) {
      if (p.name == name) return p;
      names.emplace_back(p.name);
    }
    fail(column, "there is no error " + quote(name) + did_you_mean(name, names) +
                     "; `muro plugins info sensor.error` names all");
  }

  double parse_number(std::string_view text, std::size_t column) const {
    double x = 0;
    const char* end = text.data() + text.size();
    const auto [used, code] = std::from_chars(text.data(), end, x);
    if (code != std::errc{} || used != end || !std::isfinite(x)) fail(column, quote(text) + " is no number");
    return x;
  }

  PartValue parse_value(std::string_view text, std::size_t column) const {
    PartValue value{{}, "", line_, int(column)};
    const bool is_word = std::isalpha(static_cast<unsigned char>(text.front())) != 0;
    if (is_word) {
      value.word = text;
    } else if (text.front() != '[') {
      value.numbers.push_back(parse_number(text, column));
    } else {
      if (text.back() != ']') fail(column + text.size(), "`]` is missing: a list of numbers stands in one line");
      std::string_view rest = text.substr(1, text.size() - 2);
      while (true) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        const std::string_view item = without_blanks(rest.substr(0, end));
        const char* at = item.empty() ? rest.data() : item.data();
        value.numbers.push_back(parse_number(item, column + std::size_t(at - text.data())));
        if (end == rest.size()) break;
        rest.remove_prefix(end + 1);
      }
    }
    return value;
  }

  void check(const Parameter& p, const PartValue& value) const {
    const bool is_text = p.type == ParameterType::text;
    bool fine = is_text == value.numbers.empty();
    if (fine && is_text) fine = std::find(p.choices.begin(), p.choices.end(), value.word) != p.choices.end();
    for (const double x : value.numbers)
      fine = fine && x >= p.min && x <= p.max && (p.type != ParameterType::integer || x == std::floor(x));
    if (!is_text && p.type != ParameterType::reals) fine = fine && value.numbers.size() == 1;
    if (p.length > 0) fine = fine && value.numbers.size() == p.length;
    if (!fine) fail(value.line, std::size_t(value.column), quote(p.name) + " must be " + allowed(p));
  }

  std::span<const Parameter> parameters_;
  Part part_;
  int line_ = 0;
  std::size_t indentation_ = 0;  ///< column of the values of this section; 0: not known yet
};

}  // namespace

const PartSection* Part::section_of(std::string_view reading) const {
  for (const PartSection& s : sections)
    if (s.reading == reading) return &s;
  return nullptr;
}

std::string Part::place(const PartValue& value) const {
  return file + ":" + std::to_string(value.line) + ":" + std::to_string(value.column) + ": ";
}

Part parse_part(const std::string& file, std::string_view text, std::span<const Parameter> parameters) {
  return PartReader(file, parameters).read(text);
}

Part read_part(const std::string& file, std::span<const Parameter> parameters) {
  constexpr std::size_t most = 1 << 20;
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text;
  if (in) {
    text.resize(most + 1);
    in.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(in.gcount()));
  }
  if (!in.is_open() || in.bad() || (in.fail() && !in.eof()))
    throw Error("part " + file + " cannot be read: " + std::strerror(errno != 0 ? errno : EIO));
  if (text.size() > most) throw Error("part " + file + " is larger than 1 MiB; is it the right file?");
  return parse_part(file, text, parameters);
}

}  // namespace muro
