// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "checks.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/model_file/ranges.hpp"

namespace muro::sdf {

namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Whether an unsupported element has the only value that muro supports.
bool has_supported_value(const Element& e, const SchemaElement& schema) {
  if (schema.supported_value.empty()) return false;
  std::string value = lower_case(text_of(e));
  if (schema.supported_value == "true" && value == "1") value = "true";
  if (schema.supported_value == "false" && value == "0") value = "false";
  if (value == schema.supported_value) return true;
  std::string error;
  const auto a = model_file::parse_numbers(value, error), b = model_file::parse_numbers(schema.supported_value, error);
  return error.empty() && !a.empty() && a == b;
}

std::vector<std::string> supported_names(std::string_view parent) {
  std::vector<std::string> names;
  for (const SchemaElement& e : schema())
    if (e.parent == parent && e.type != ValueType::unsupported) names.emplace_back(e.name);
  return names;
}

/// Returns the numbers at the beginning of a text; nothing if there are fewer than `count`.
std::optional<std::vector<double>> first_numbers(const std::string& text, std::size_t count) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (values.size() < count) {
    while (at < end && std::isspace(static_cast<unsigned char>(*at))) ++at;
    if (at < end && *at == '+') ++at;
    double value = 0;
    const auto [rest, code] = std::from_chars(at, end, value);
    if (code != std::errc() || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
    at = rest;
  }
  return values;
}

/// Replaces angles by a quaternion. The bits of the quaternion that libsdformat computes depend on the processor.
void write_quaternion(Element& pose) {
  std::string error;
  const auto values = model_file::parse_numbers(text_of(pose), 6, error);
  if (!values) return;  // reported before
  const std::string degrees = lower_case(attribute(pose, "degrees"));
  const double unit = degrees == "true" || degrees == "1" ? M_PI / 180 : 1;
  const std::vector<double>& v = *values;
  const Quat q = from_rpy(unit * v[3], unit * v[4], unit * v[5]);
  pose.SetText(model_file::text_of({v[0], v[1], v[2], q.x(), q.y(), q.z(), q.w()}).c_str());
  pose.SetAttribute("rotation_format", "quat_xyzw");
  pose.DeleteAttribute("degrees");
}

}  // namespace

std::string text_of(const Element& e) {
  const char* text = e.GetText();
  std::string_view full = text ? text : "";
  const std::size_t begin = full.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return std::string(full.substr(begin, full.find_last_not_of(" \t\r\n") + 1 - begin));
}

std::string child_text(Element& e, const char* name) {
  const Element* child = e.FirstChildElement(name);
  return child ? text_of(*child) : std::string();
}

void check(SourceFile& source, SourceFiles& sources, Problems& problems) { Check(source, sources, problems).run(); }

void Check::run() {
  section(*source_.document->root(), "sdf");
  missing_meshes_.report(problems_);
  left_out_.report(problems_);
}

void Check::error(const FileLocation& at, const std::string& text) {
  if (model_of_world_.empty()) return problems_.error(at, text);
  is_model_bad_ = true;
  problems_.warning(at, concat(model_of_world_, " is left out: ", text));
}

void Check::child_section(Element& child, std::string_view as) {
  const bool is_model_of_world = as == "model" && std::string_view(child.Parent()->Value()) == "world";
  if (!is_model_of_world) return section(child, as);
  model_of_world_ = concat("model ", quote(attribute(child, "name")));
  is_model_bad_ = false;
  tinyxml2::XMLNode* const world = child.Parent();
  section(child, as);
  if (is_model_bad_) world->DeleteChild(&child);
  model_of_world_.clear();
}

void Check::section(Element& e, std::string_view as) {
  attributes(e, as);
  prepare(e, as);
  std::set<std::string> seen;
  for (Element* child : model_file::children(e)) {
    const std::string name = child->Name();
    const SchemaElement* schema = find_in_schema(as, name);
    if (!schema || schema->type == ValueType::unsupported) {
      remove_unsupported(*child, schema, as);
    } else if (!schema->repeatable && !seen.insert(name).second) {
      problems_.warning(location_of(*child), concat("a second <", name, "> in one <", e.Name(), "> is left out"));
      e.DeleteChild(child);
    } else if (schema->type == ValueType::device) {
      take_device(*child);
    } else if (schema->type == ValueType::section) {
      child_section(*child, schema->section);
    } else {
      leaf(*child, *schema);
    }
  }
  // the last call, as it may remove the element
  if (!complete(e, as) && e.Parent()) e.Parent()->DeleteChild(&e);
}

void Check::attributes(Element& e, std::string_view section) {
  std::vector<std::string> unknown;
  for (const auto* a = e.FirstAttribute(); a; a = a->Next())
    if (!is_attribute_of(section, a->Name())) unknown.emplace_back(a->Name());
  for (const std::string& name : unknown) {
    // names with a prefix are for other programs
    if (name.find(':') == std::string::npos && name != "xmlns")
      problems_.warning(location_of(e),
                        concat("<", e.Name(), "> has the attribute ", quote(name), ", which is not read"));
    e.DeleteAttribute(name.c_str());
  }
}

void Check::leaf(Element& e, const SchemaElement& schema) {
  attributes(e, schema.type == ValueType::pose ? "pose" : schema.name);
  for (Element* child : model_file::children(e)) remove_unsupported(*child, nullptr, schema.name);
  switch (schema.type) {
    case ValueType::numbers:
      return numbers(e, std::size_t(schema.count), false);
    case ValueType::limit:
      return numbers(e, 1, true);
    case ValueType::pose: {
      const std::string format = attribute(e, "rotation_format");
      const bool quaternion = format == "quat_xyzw";
      if (text_of(e).empty()) e.SetText(quaternion ? "0 0 0 0 0 0 1" : "0 0 0 0 0 0");
      const std::size_t count = quaternion ? 7 : 6;
      std::string wrong;
      if (!model_file::parse_numbers(text_of(e), count, wrong))
        return error(location_of(e), concat("<pose>: ", quote(text_of(e)), " ", wrong));
      numbers(e, count, false);
      if (format.empty() || format == "euler_rpy") write_quaternion(e);
      return;
    }
    case ValueType::color: {
      std::string error;
      const auto values = model_file::parse_numbers(text_of(e), error);
      return numbers(e, values.size() == 3 ? 3 : 4, false);
    }
    case ValueType::flag: {
      const std::string value = lower_case(text_of(e));
      if (value == "true" || value == "1" || value == "false" || value == "0") return;
      const std::string wrong = concat("<", e.Name(), ">: ", quote(text_of(e)), " is none of true, false, 1, 0");
      // libsdformat also reads these elements
      if (!value.empty() && std::string_view(e.Name()) != "use_parent_model_frame") return error(location_of(e), wrong);
      problems_.warning(location_of(e), wrong + "; it is left out");
      e.Parent()->DeleteChild(&e);
      return;
    }
    default: {
      const std::string text = text_of(e);
      e.DeleteChildren();
      e.SetText(text.c_str());
    }
  }
}

/// Reads numbers as libsdformat does: an empty text has no number, and text after the last number is ignored.
void Check::numbers(Element& e, std::size_t count, bool infinite) {
  const std::string text = text_of(e);
  if (infinite && (lower_case(text) == "inf" || lower_case(text) == "-inf" || lower_case(text) == "+inf")) return;
  if (text.empty()) {
    problems_.warning(location_of(e), concat("<", e.Name(), "> holds no number and is left out"));
    e.Parent()->DeleteChild(&e);
    return;
  }
  std::string problem;
  auto values = model_file::parse_numbers(text, count, problem);
  if (!values) {
    values = first_numbers(text, count);
    if (values) {
      problems_.warning(location_of(e), concat("<", e.Name(), ">: ", quote(text), " ", problem, ". It is read as ",
                                               quote(model_file::text_of(*values))));
      problem.clear();
    }
  }
  if (values) {
    model_file::drop_tiny_sizes(e.Name(), *values);
    problem = model_file::range_problem(e.Name(), *values);
  }
  const bool is_out_of_range = values || problem.find("is not finite") != problem.npos;
  if (is_out_of_range && !problem.empty() && std::string_view(e.Name()) != "pose") {
    problems_.warning(location_of(e), concat("<", e.Name(), ">: ", quote(text), " ", problem, "; it is left out"));
    e.Parent()->DeleteChild(&e);
    return;
  }
  if (!values || !problem.empty())
    return error(location_of(e), concat("<", e.Name(), ">: ", quote(text), " ", problem));
  e.DeleteChildren();
  e.SetText(model_file::text_of(*values).c_str());
}

void Check::remove_unsupported(Element& e, const SchemaElement* schema, std::string_view parent) {
  if (schema && has_supported_value(e, *schema)) {
    e.Parent()->DeleteChild(&e);
    return;
  }
  const std::string name = e.Name();
  const bool foreign = name.find(':') != std::string::npos;  // namespace of another program
  const auto* section = e.Parent()->ToElement();
  const std::string element = concat("<", name, "> in <", section ? section->Name() : "", ">");
  if (schema)
    left_out_.add(schema->severity, element, std::string(schema->reason), location_of(e));
  else if (foreign)
    left_out_.add(Severity::note, element, "it is meant for another program", location_of(e));
  else
    left_out_.add(Severity::warning, element,
                  "SDFormat has no such element there" + did_you_mean(name, supported_names(parent)), location_of(e));
  e.Parent()->DeleteChild(&e);
}

}  // namespace muro::sdf
