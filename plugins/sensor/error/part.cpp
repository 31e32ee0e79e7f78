// SPDX-License-Identifier: MIT
#include "part.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

constexpr std::string_view reading_name = "reading";

std::string number_text(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

/// Returns the values that a parameter allows, for messages.
std::string allowed(const Parameter& p) {
  if (!p.choices.empty()) return "one of " + quoted_list(p.choices);
  std::string text = p.type == ParameterType::reals     ? "numbers"
                     : p.type == ParameterType::integer ? "a whole number"
                                                        : "a number";
  if (std::isfinite(p.min) && std::isfinite(p.max)) text += " from " + number_text(p.min) + " to " + number_text(p.max);
  return text;
}

bool is_allowed(const Parameter& p, const PartValue& value) {
  if (p.type == ParameterType::text)
    return std::find(p.choices.begin(), p.choices.end(), value.word) != p.choices.end();
  if (p.type != ParameterType::reals && value.numbers.size() != 1) return false;
  return std::all_of(value.numbers.begin(), value.numbers.end(), [&](double x) {
    return x >= p.min && x <= p.max && (p.type != ParameterType::integer || x == std::floor(x));
  });
}

PartValue value_of(const PartFile& file, const PartFile::Entry& entry, const Parameter& p) {
  PartValue value{{}, "", file.place(entry)};
  if (p.type == ParameterType::text)
    value.word = entry.value;
  else
    value.numbers = file.numbers(entry);
  if (!is_allowed(p, value)) throw Error(value.place + quote(p.name) + " must be " + allowed(p));
  return value;
}

PartSection section_in(const PartFile& file, const std::string& name, std::span<const Parameter> parameters) {
  PartSection section{name, "", {}};
  const PartFile::Entry* const reading = file.find(name, reading_name);
  const auto first = std::find_if(file.entries().begin(), file.entries().end(),
                                  [&](const PartFile::Entry& entry) { return entry.section == name; });
  if (!reading)
    throw Error(file.place_of_name(*first) + "section " + quote(name) +
                " has no `reading`: the property whose errors it has, such as `reading: angular_velocity`");
  section.reading = reading->value;
  for (const PartFile::Entry& entry : file.entries())
    if (entry.section == name && entry.name != reading_name)
      for (const Parameter& p : parameters)
        if (p.name == entry.name) section.values.emplace(entry.name, value_of(file, entry, p));
  return section;
}

}  // namespace

const PartSection* Part::section_of(std::string_view reading) const {
  for (const PartSection& s : sections)
    if (s.reading == reading) return &s;
  return nullptr;
}

Part make_part(const PartFile& file, std::span<const Parameter> parameters) {
  std::vector<std::string_view> names{reading_name};
  for (const Parameter& p : parameters) names.push_back(p.name);
  Part part{file.name(), {}};
  for (const PartFile::Entry& entry : file.entries())
    if (entry.section.empty())
      throw Error(file.place_of_name(entry) + quote(entry.name) + " stands in no section, such as `gyro:`");
  for (const std::string& name : file.sections()) {
    file.check_names(name, names);
    PartSection section = section_in(file, name, parameters);
    if (const PartSection* const other = part.section_of(section.reading))
      throw Error(file.place(*file.find(name, reading_name)) + "sections " + quote(other->name) + " and " +
                  quote(name) + " are both of " + quote(section.reading));
    part.sections.push_back(std::move(section));
  }
  if (part.sections.empty())
    throw Error(file.name() + ":1:1: there is no section; a part has one for each of its readings, such as `gyro:`");
  return part;
}

}  // namespace muro
