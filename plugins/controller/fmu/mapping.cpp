// SPDX-License-Identifier: MIT
#include "mapping.hpp"

#include <algorithm>
#include <charconv>

#include "muro/algorithm.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

std::string words_of(std::string_view parameter) { return "`" + std::string(parameter) + "`: "; }

bool may_be_mapped(const Variable& v, std::string_view parameter) {
  if (parameter == "outputs") return v.causality == Causality::output || v.causality == Causality::local;
  if (parameter == "inputs") return v.causality == Causality::input || v.is_tunable;
  return v.may_be_set;
}

constexpr std::string_view what_may_be_mapped(std::string_view parameter) {
  if (parameter == "outputs") return "an output";
  if (parameter == "inputs") return "an input or a tunable parameter";
  return "a parameter, an input, or a variable with `initial` exact or approx";
}

/// The variable before one of the signs = in "variable=..."; their names may hold such signs.
std::size_t variable_of(std::string_view parameter, std::string_view text, const ModelDescription& d,
                        std::string_view& rest) {
  std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0)
    throw Error(words_of(parameter) + quote(text) +
                " must be \"variable=" + (parameter == "parameters" ? "value" : "object:property") + "\"");
  const std::string_view name = text.substr(0, equals);
  const Variable* found = nullptr;
  for (; equals != text.npos && !found; equals = text.find('=', equals + 1)) {
    found = d.find(text.substr(0, equals));
    rest = text.substr(equals + 1);
  }
  std::vector<std::string> candidates;
  for (const Variable& v : d.variables)
    if (may_be_mapped(v, parameter)) candidates.push_back(v.name);
  if (!found)
    throw Error(words_of(parameter) + quote(text) + ": the FMU has no variable " + quote(name) +
                did_you_mean(name, candidates) + "; what may stand here: " + quoted_list(candidates));
  if (!may_be_mapped(*found, parameter))
    throw Error(words_of(parameter) + quote(text) + ": " + quote(found->name) + " is not " +
                std::string(what_may_be_mapped(parameter)) + "; what may stand here: " + quoted_list(candidates));
  return std::size_t(found - d.variables.data());
}

Reference read_reference(std::string_view text, const std::string& about) {
  Reference r;
  if (text.ends_with(']')) {
    const std::size_t open = text.rfind('[');
    if (open == text.npos) throw Error(about + quote(text) + " has a ] without [");
    r.selection = text.substr(open + 1, text.size() - open - 2);
    text = text.substr(0, open);
  }
  const std::size_t colon = text.rfind(':');
  if (colon != text.npos) r.object = text.substr(0, colon);
  r.property = text.substr(colon == text.npos ? 0 : colon + 1);
  if (r.property.empty()) throw Error(about + "names no property");
  return r;
}

std::optional<std::uint64_t> index_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || value > 0xffffffffu) return std::nullopt;
  return value;
}

/// Sets which scalars of its property a place is.
void select(Place& place, std::string_view selection, const std::string& name) {
  const ValueType& type = *place.property.key->type;
  const std::size_t dots = selection.find("..");
  const auto first = index_in(selection.substr(0, dots));
  const auto last = dots == selection.npos ? first : index_in(selection.substr(dots + 2));
  if (first && last && *first <= *last) {
    place.first = *first;
    place.count = *last - *first + 1;
    return;
  }
  const auto label = std::find(type.labels.begin(), type.labels.end(), selection);
  if (label == type.labels.end() || place.property.multiplicity != Multiplicity::single)
    throw Error(quote(selection) + " is no scalar of " + name + "; they are numbered from 0, as in [0] or [0..2]" +
                (type.labels.empty() ? "" : ", or called " + quoted_list(type.labels)));
  place.first = std::uint64_t(label - type.labels.begin());
  place.count = 1;
}

}  // namespace

Mapping read_mapping(std::string_view parameter, std::span<const std::string_view> texts, const ModelDescription& d) {
  Mapping all;
  for (const std::string_view text : texts) {
    std::string_view rest;
    const std::size_t variable = variable_of(parameter, text, d, rest);
    const std::string about = words_of(parameter) + quote(text) + " ";
    const auto [entry, is_new] = all.try_emplace(variable);
    if (!is_new) throw Error(about + "maps " + quote(d.variables[variable].name) + " a second time");
    while (true) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      entry->second.push_back(read_reference(rest.substr(0, comma), about));
      if (comma == rest.size()) break;
      rest.remove_prefix(comma + 1);
    }
  }
  return all;
}

StartValues read_start_values(std::span<const std::string_view> texts, const ModelDescription& d) {
  StartValues all;
  for (const std::string_view text : texts) {
    std::string_view rest;
    const std::size_t variable = variable_of("parameters", text, d, rest);
    if (!all.try_emplace(variable, rest).second)
      throw Error(words_of("parameters") + quote(d.variables[variable].name) + " is given twice");
  }
  return all;
}

PropertySearch::PropertySearch(const Connector& connector, const Item& item) : connector_(connector), item_(item) {
  objects_.push_back(item.object);
  const auto add = [&](ObjectId o) {
    if (std::find(objects_.begin(), objects_.end(), o) == objects_.end()) objects_.push_back(o);
  };
  if (item.robot) add(item.robot->base());
  preferred_ = objects_.size();
  for (std::uint32_t o = 0; item.robot && o < connector.object_count(); ++o)
    if (connector.robot_of(ObjectId{o}) == std::int32_t(item.robot->number)) add(ObjectId{o});
}

std::string PropertySearch::owner() const { return item_.robot ? "robot " + quote(item_.robot->name) : "the world"; }

std::string PropertySearch::local_name(ObjectId object) const {
  std::string name(connector_.object_name(object));
  if (item_.robot && name.starts_with(std::string(item_.robot->name) + "/"))
    name.erase(0, item_.robot->name.size() + 1);
  return name;
}

std::string PropertySearch::name_of(const FoundProperty& p) const {
  return quote(std::string(connector_.object_name(p.object)) + ":" + std::string(p.key->name));
}

ObjectId PropertySearch::object(std::string_view name) const {
  ObjectId found = no_object;
  if (item_.robot) found = connector_.find_object(std::string(item_.robot->name) + "/" + std::string(name));
  return found != no_object ? found : connector_.find_object(name);
}

/// Valid until the next call of this or of Connector::properties.
const FoundProperty* PropertySearch::property_of(ObjectId object, std::string_view name) const {
  for (const FoundProperty& p : connector_.properties(object))
    if (p.key->name == name && !p.is_sum) return &p;
  return nullptr;
}

std::optional<FoundProperty> PropertySearch::anywhere(std::string_view property) const {
  std::vector<FoundProperty> found;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (const FoundProperty* p = property_of(objects_[i], property)) found.push_back(*p);
    if (i < preferred_ && !found.empty()) return found.front();
  }
  if (found.empty()) {
    if (const FoundProperty* p = property_of(world_object, property)) return *p;
    return std::nullopt;
  }
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const FoundProperty& p : found) names.push_back(local_name(p.object));
  throw Error("several objects of " + owner() + " have a property " + quote(property) + ": " + quoted_list(names) +
              "; name one, as in \"" + names[0] + ":" + std::string(property) + "\"");
}

Place PropertySearch::place_of(const Reference& r) const {
  std::vector<std::string> names;
  std::optional<FoundProperty> found;
  if (r.object.empty()) {
    found = anywhere(r.property);
    for (const ObjectId o : objects_)
      for (const FoundProperty& p : connector_.properties(o)) names.emplace_back(p.key->name);
  } else {
    const ObjectId o = object(r.object);
    if (o == no_object) {
      for (const ObjectId known : objects_) names.push_back(local_name(known));
      throw Error(owner() + " has no object " + quote(r.object) + did_you_mean(r.object, names) + "; it has " +
                  quoted_list(names));
    }
    if (const FoundProperty* p = property_of(o, r.property)) found = *p;
    for (const FoundProperty& p : connector_.properties(o)) names.emplace_back(p.key->name);
  }
  if (!found) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    throw Error((r.object.empty() ? "no object of " + owner() + " has" : "object " + quote(r.object) + " has no") +
                (r.object.empty() ? " a property " : " property ") + quote(r.property) +
                did_you_mean(r.property, names) + "; there are " + quoted_list(names) + "; `muro describe` lists all");
  }
  Place place{*found, 0, {}};
  if (r.selection) select(place, *r.selection, name_of(*found));
  return place;
}

std::vector<Place> PropertySearch::places(std::span<const Reference> references) const {
  std::vector<Place> all;
  for (const Reference& r : references) all.push_back(place_of(r));
  return all;
}

std::optional<Place> PropertySearch::place_of(std::string_view variable, bool is_input) const {
  const std::optional<FoundProperty> found = anywhere(variable);
  if (!found) return std::nullopt;
  if (is_input)
    if (const FoundProperty* measured = property_of(found->object, std::string(variable) + ".measured"))
      return Place{*measured, 0, {}};
  return Place{*found, 0, {}};
}

}  // namespace muro::fmu
