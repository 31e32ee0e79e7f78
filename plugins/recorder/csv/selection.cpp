// SPDX-License-Identifier: MIT
#include "selection.hpp"

#include <algorithm>
#include <set>

#include "glob.hpp"
#include "muro/algorithm.hpp"
#include "muro/nearest.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

namespace {

bool is_sum(const Connector& c, const FoundProperty& p) {
  return c.is_used(p.object, *p.key, Access::accumulate) || c.is_used(p.object, *p.key, Access::read_sum);
}

bool is_constant(const Connector& c, const FoundProperty& p) {
  if (is_sum(c, p)) return false;
  for (const Access a : {Access::variable, Access::derived, Access::write, Access::offer, Access::input})
    if (c.is_used(p.object, *p.key, a)) return false;
  return true;
}

/// Why a property cannot stand in columns; "" when it can.
std::string hindrance(const FoundProperty& p) {
  if (p.form == Form::list) return "is a list, whose length changes from row to row";
  if (size_of(p.key->type->scalar) == 0)
    return "has no columns: it is of type " + std::string(p.key->type->name) + ", which is not made of numbers";
  return "";
}

std::string name_of(const Connector& c, const FoundProperty& p) {
  return std::string(c.object_name(p.object)) + ":" + std::string(p.key->name);
}

/// Everything that there is, by name. Sums are not among the properties of an object; the one that the vocabulary has
/// is looked for.
std::vector<std::pair<std::string, FoundProperty>> all_properties(const Connector& c) {
  std::vector<std::pair<std::string, FoundProperty>> all;
  for (std::uint32_t o = 0; o < c.object_count(); ++o) {
    for (const FoundProperty& p : c.properties(ObjectId{o})) all.emplace_back(name_of(c, p), p);
    const FoundProperty sum{ObjectId{o}, &keys::external_wrench};
    if (is_sum(c, sum)) all.emplace_back(name_of(c, sum), sum);
  }
  return all;
}

}  // namespace

Source::Source(Connector& connector, const FoundProperty& p, std::string name)
    : name_(std::move(name)),
      form_(p.form),
      scalar_(p.key->type->scalar),
      labels_(p.key->type->labels),
      is_sum_(is_sum(connector, p)) {
  if (is_sum_)
    sum_ = connector.read_sum(p.object, keys::external_wrench);
  else
    place_ = connector.read_any(p);
}

std::vector<std::string> Source::titles() const {
  std::vector<std::string> titles;
  const std::uint64_t elements = form_ == Form::array ? static_cast<const ArrayHeader*>(place_)->size : 1;
  for (std::uint64_t i = 0; i < elements; ++i) {
    const std::string element = form_ == Form::array ? name_ + "[" + std::to_string(i) + "]" : name_;
    if (labels_.empty()) titles.push_back(element);
    for (const std::string_view label : labels_) titles.push_back(element + "." + std::string(label));
  }
  return titles;
}

std::vector<Source> select(Connector& c, std::span<const std::string_view> patterns) {
  std::vector<std::string> wanted(patterns.begin(), patterns.end());
  if (wanted.empty())
    for (const RobotView* robot : c.robots()) wanted.push_back(std::string(c.object_name(robot->base())) + ":pose");
  const auto all = all_properties(c);
  std::vector<Source> sources;
  std::set<std::string> taken;
  for (const std::string& pattern : wanted) {
    const bool exact = pattern.find_first_of("*?") == std::string::npos;
    bool fitting = false;
    std::string passed_over;
    for (const auto& [name, property] : all) {
      if (!fits(pattern, name)) continue;
      const std::string hindered = hindrance(property);
      if (exact && !hindered.empty()) throw Error("`" + name + "` cannot be recorded: it " + hindered);
      if (!exact && (!hindered.empty() || is_constant(c, property) || property.key->name.rfind("state.", 0) == 0)) {
        passed_over = name;
        continue;
      }
      fitting = true;
      if (taken.insert(name).second) sources.emplace_back(c, property, name);
    }
    if (fitting) continue;
    if (!passed_over.empty())
      throw Error("`" + pattern + "` fits only what does not change or has no columns, such as `" + passed_over +
                  "`; name a constant without wildcards to record it");
    std::vector<std::string> names;
    for (const auto& [name, unused] : all) names.push_back(name);
    throw Error("no property fits `" + pattern + "`" + did_you_mean(pattern, names) +
                "; write \"object:property\", such as \"rover_0/base_link:pose\"; `muro describe` lists all");
  }
  return sources;
}

}  // namespace muro
