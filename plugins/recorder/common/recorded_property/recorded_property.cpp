// SPDX-License-Identifier: MIT
#include "recorded_property.hpp"

#include <algorithm>
#include <set>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

/// Returns why a property does not fit into columns; "" when it does.
std::string why_unfit(const FoundProperty& p) {
  if (p.multiplicity == Multiplicity::list) return "is a list, whose length changes from row to row";
  if (size_of(p.key->type->scalar) == 0)
    return "has no columns: it is of type " + std::string(p.key->type->name) + ", which is not made of numbers";
  if (p.is_sum && p.key->type->scalar != Scalar::f64) return "is a sum of what is not real numbers (f64)";
  return "";
}

std::string name_of(const Connector& c, const FoundProperty& p) {
  return std::string(c.object_name(p.object)) + ":" + std::string(p.key->name);
}

/// Returns all properties with their names.
std::vector<std::pair<std::string, FoundProperty>> all_properties(const Connector& c) {
  std::vector<std::pair<std::string, FoundProperty>> all;
  for (std::uint32_t o = 0; o < c.object_count(); ++o)
    for (const FoundProperty& p : c.properties(ObjectId{o})) all.emplace_back(name_of(c, p), p);
  return all;
}

}  // namespace

RecordedProperty::RecordedProperty(Connector& connector, const FoundProperty& p, std::string name)
    : name_(std::move(name)),
      multiplicity_(p.multiplicity),
      scalar_(p.key->type->scalar),
      labels_(p.key->type->labels),
      data_(connector.read_any(p)),
      is_sum_(p.is_sum) {}

std::vector<std::string> RecordedProperty::titles() const {
  std::vector<std::string> titles = elements();
  for (std::string& title : titles) title.insert(0, name_);
  return titles;
}

std::vector<std::string> RecordedProperty::elements() const {
  std::vector<std::string> all;
  const bool is_array = multiplicity_ == Multiplicity::array;
  const std::uint64_t count = is_array ? static_cast<const ArrayHeader*>(data_)->size : 1;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string element = is_array ? "[" + std::to_string(i) + "]" : "";
    if (labels_.empty()) all.push_back(element);
    for (const std::string_view label : labels_) all.push_back(element + "." + std::string(label));
  }
  return all;
}

std::vector<RecordedProperty> select(Connector& c, std::span<const std::string_view> patterns) {
  std::vector<std::string> chosen(patterns.begin(), patterns.end());
  if (chosen.empty())
    for (const RobotView* robot : c.robots()) chosen.push_back(std::string(c.object_name(robot->base())) + ":pose");
  const auto all = all_properties(c);
  std::vector<RecordedProperty> selected;
  std::set<std::string> taken;
  for (const std::string& pattern : chosen) {
    const bool exact = pattern.find_first_of("*?") == std::string::npos;
    bool matched = false;
    std::string skipped;
    for (const auto& [name, property] : all) {
      if (!matches(pattern, name)) continue;
      const std::string unfit = why_unfit(property);
      if (exact && !unfit.empty()) throw Error(quote(name) + " cannot be recorded: it " + unfit);
      if (!exact && (!unfit.empty() || property.is_constant || property.key->name.rfind("state.", 0) == 0)) {
        skipped = name;
        continue;
      }
      matched = true;
      if (taken.insert(name).second) selected.emplace_back(c, property, name);
    }
    if (matched) continue;
    if (!skipped.empty())
      throw Error(quote(pattern) + " matches only what does not change or has no columns, such as " + quote(skipped) +
                  "; name a constant without wildcards to record it");
    std::vector<std::string> names;
    for (const auto& [name, unused] : all) names.push_back(name);
    throw Error("no property matches " + quote(pattern) + did_you_mean(pattern, names) +
                "; write \"object:property\", such as \"rover_0/base_link:pose\"; `muro describe` lists all");
  }
  return selected;
}

}  // namespace muro
