// SPDX-License-Identifier: MIT
#include "fields.hpp"

#include <algorithm>

#include "plugins/common/model_file/numbers.hpp"

namespace muro::sdf_devices {

std::string text_of(const Element& e) {
  const char* const value = e.Attribute("value");
  const char* const text = value ? value : e.GetText();
  const std::string_view full = text ? text : "";
  const std::size_t begin = full.find_first_not_of(" \t\r\n");
  if (begin == full.npos) return {};
  return std::string(full.substr(begin, full.find_last_not_of(" \t\r\n") + 1 - begin));
}

Element* Fields::take(const char* name) {
  Element* const found = parent_.FirstChildElement(name);
  for (const Element* e = found; e; e = e->NextSiblingElement(name)) read_.push_back(e);
  return found;
}

std::optional<std::vector<double>> Fields::numbers(const char* name, std::size_t count, double low, double high) {
  const Element* const e = take(name);
  if (!e) return std::nullopt;
  const std::string text = text_of(*e);
  std::string error;
  auto values = model_file::parse_numbers(text, count, error);
  const auto outside = [&](double v) { return v < low || v > high; };
  if (values && std::none_of(values->begin(), values->end(), outside)) return values;
  if (values) {
    for (double& v : *values) v = std::clamp(v, low, high);
    messages_.problems.warning(messages_.at(*e),
                               concat(owner_, ": <", name, "> ", quote(text), " is not from ", low, " to ", high,
                                      "; it is taken as ", quote(model_file::text_of(*values))));
    return values;
  }
  messages_.problems.warning(messages_.at(*e),
                             concat(owner_, ": <", name, "> ", quote(text), " ", error, "; it is left out"));
  return std::nullopt;
}

std::optional<double> Fields::number(const char* name, double low, double high) {
  const auto values = numbers(name, 1, low, high);
  return values ? std::optional(values->front()) : std::nullopt;
}

std::string Fields::text(const char* name) {
  const Element* const e = take(name);
  return e ? text_of(*e) : std::string();
}

std::optional<bool> Fields::flag(const char* name) {
  const Element* const e = take(name);
  if (!e) return std::nullopt;
  std::string text = text_of(*e);
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  messages_.problems.warning(messages_.at(*e), concat(owner_, ": <", name, "> ", quote(text),
                                                      " is none of true, false, 1, 0; it is left out"));
  return std::nullopt;
}

Element* Fields::section(const char* name) { return take(name); }

std::vector<Element*> Fields::sections(const char* name) {
  take(name);
  return model_file::children(parent_, name);
}

bool Fields::is_read(const Element& child) const {
  return std::find(read_.begin(), read_.end(), &child) != read_.end();
}

void Fields::skip(std::initializer_list<const char*> names, const std::string& reason) {
  for (const char* name : names)
    for (const Element* e = take(name); e; e = e->NextSiblingElement(name))
      messages_.left_out.add(Severity::note, concat("<", name, "> in <", parent_.Name(), ">"), reason,
                             messages_.at(*e));
}

void Fields::list_unread(const std::string& reason) {
  for (const Element* e = parent_.FirstChildElement(); e; e = e->NextSiblingElement())
    if (!is_read(*e))
      messages_.left_out.add(Severity::warning, concat("<", e->Name(), "> in <", parent_.Name(), ">"), reason,
                             messages_.at(*e));
}

}  // namespace muro::sdf_devices
