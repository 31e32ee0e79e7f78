// SPDX-License-Identifier: MIT
#include "mapping.hpp"

#include <algorithm>
#include <charconv>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
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

/// Returns the variable before one of the signs = in "variable=..."; names of variables may contain this sign, too.
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
  if (found->causality == Causality::structural_parameter && parameter != "parameters")
    throw Error(words_of(parameter) + quote(text) + ": " + quote(found->name) +
                " is a structural parameter, which keeps its value during the run; give that in `parameters`");
  if (!may_be_mapped(*found, parameter))
    throw Error(words_of(parameter) + quote(text) + ": " + quote(found->name) + " is not " +
                std::string(what_may_be_mapped(parameter)) + "; what may stand here: " + quoted_list(candidates));
  return std::size_t(found - d.variables.data());
}

Reference read_scalars(std::string_view text, const std::string& about) {
  Reference r;
  if (text.ends_with(']')) {
    const std::size_t open = text.rfind('[');
    if (open == text.npos) throw Error(about + quote(text) + " has a ] without [");
    r.selection = text.substr(open + 1, text.size() - open - 2);
    text = text.substr(0, open);
  }
  r.property = read_reference(text);
  if (r.property.property.empty()) throw Error(about + "names no property");
  return r;
}

std::optional<std::uint64_t> index_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || value > 0xffffffffu) return std::nullopt;
  return value;
}

/// Sets the scalars of a place from a selection.
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
      entry->second.push_back(read_scalars(rest.substr(0, comma), about));
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

std::vector<Place> places_of(const PropertySearch& search, std::span<const Reference> references, bool is_input,
                             std::string_view variable) {
  std::vector<Place> all;
  for (const Reference& r : references) {
    Place place{is_input ? search.find(r.property, "inputs", variable)
                         : search.find_output(r.property, "outputs", variable)};
    if (r.selection) select(place, *r.selection, search.name_of(place.property));
    all.push_back(place);
  }
  return all;
}

std::optional<Place> place_of(const PropertySearch& search, std::string_view variable, bool is_input) {
  const std::optional<FoundProperty> found = search.only(variable, is_input ? "inputs" : "outputs", variable);
  if (!found) return std::nullopt;
  return Place{is_input ? search.measured(*found).value_or(*found) : *found};
}

}  // namespace muro::fmu
