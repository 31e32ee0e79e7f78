// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

/// Checks sizes that are known before the start; those of arrays are not. Done before the check of units, whose message
/// would be misleading.
void check_known_sizes(const PropertySearch& search, const Variable& variable, std::span<const Place> places) {
  std::uint64_t count = 0;
  for (const Place& p : places) {
    if (p.property.multiplicity != Multiplicity::single) return;
    count += p.count.value_or(p.property.key->type->scalars());
  }
  if (variable.type != Type::string)
    check_size(variable, count, search.name_of(places.front().property) + (places.size() > 1 ? " and others" : ""));
}

void check_type(const Variable& v, const FoundProperty& p, bool is_input, const std::string& about) {
  const ValueType& type = *p.key->type;
  if (v.type == Type::string)
    throw Error(about + "it is a text, and properties hold numbers; " +
                (is_input ? "give it in `parameters`" : "it can only be left out"));
  if (size_of(type.scalar) == 0)
    throw Error(about + "that is of type " + std::string(type.name) + ", which is not made of numbers");
  if (v.type == Type::binary && type.scalar != Scalar::u8)
    throw Error(about + "it is binary data, and that is made of " + std::string(type.name) +
                "; properties of bytes, such as camera.image, fit");
  if (p.multiplicity == Multiplicity::list)
    throw Error(about + "that is a list, whose length changes from step to step");
}

/// Whether a place contains this scalar of an element.
bool holds(const Place& place, std::uint32_t scalar, std::uint32_t scalars) {
  const std::uint64_t count = place.count.value_or(scalars);
  return count >= scalars || (scalar + scalars - place.first % scalars) % scalars < count;
}

}  // namespace

void Binder::bind(const Item& item, Exchange& inputs, Exchange& outputs) {
  const PropertySearch search(connector_, item, of_robots_);
  std::vector<std::string_view> open;
  for (std::size_t v = 0; v < description_.variables.size(); ++v) {
    const Variable& variable = description_.variables[v];
    if (const auto in = inputs_.find(v); in != inputs_.end()) {
      join(search, variable, places_of(search, in->second, true, variable.name), true, inputs);
    } else if (variable.causality == Causality::input && variable.size > 0 && !has_value_(v)) {
      if (const auto place = place_of(search, variable.name, true))
        join(search, variable, std::span(&*place, 1), true, inputs);
      else
        open.push_back(variable.name);
    }
    if (const auto out = outputs_.find(v); out != outputs_.end()) {
      join(search, variable, places_of(search, out->second, false, variable.name), false, outputs);
    } else if (variable.causality == Causality::output && variable.size > 0) {
      // an output such as `twist` must not write the twist itself: only commands are connected
      const auto place = place_of(search, variable.name, false);
      if (place && place->property.key->role == Role::command)
        join(search, variable, std::span(&*place, 1), false, outputs);
    }
  }
  if (!open.empty())
    throw Error("its inputs " + quoted_list(open) +
                " are not connected: no property has that name. Connect them in `inputs`, as in [\"" +
                std::string(open.front()) + "=object:property\"], or give them a value in `parameters`, as in [\"" +
                std::string(open.front()) + "=0\"], or a column in `input_file`");
}

void Binder::join(const PropertySearch& search, const Variable& variable, std::span<const Place> places, bool is_input,
                  Exchange& exchange) {
  check_known_sizes(search, variable, places);
  std::vector<Run> runs;
  for (const Place& place : places) runs.push_back(run_of(search, variable, place, is_input));
  exchange.add(variable, std::move(runs), description_.version);
}

Run Binder::run_of(const PropertySearch& search, const Variable& variable, const Place& place, bool is_input) {
  const FoundProperty& p = place.property;
  const std::string about = "variable " + quote(variable.name) + " cannot be connected to " + search.name_of(p) + ": ";
  check_type(variable, p, is_input, about);
  Run run;
  run.multiplicity = p.multiplicity;
  run.type = p.key->type;
  run.first = place.first;
  run.wanted = place.count;
  run.name = search.name_of(p);
  run.conversions = conversions(search, variable, place, about);
  void*& handle = handles_[{p.object, std::string(p.key->name), is_input}];
  if (!handle) handle = is_input ? const_cast<void*>(connector_.read_any(p)) : connector_.write_any(p);
  run.handle = handle;
  return run;
}

/// Returns one conversion for each scalar of an element; none when no number changes.
std::vector<Conversion> Binder::conversions(const PropertySearch& search, const Variable& v, const Place& place,
                                            const std::string& about) const {
  if (v.unit.empty() || v.type == Type::binary) return {};
  const auto defined = description_.units.find(v.unit);
  const Unit unit = defined == description_.units.end() ? Unit{v.unit, {}} : defined->second;
  const KeyInfo& key = *place.property.key;
  const bool is_prismatic = search.joint_of(place.property.object) == JointKind::prismatic;
  std::vector<Conversion> all(key.type->scalars());
  for (std::uint32_t s = 0; s < all.size(); ++s) {
    if (!holds(place, s, std::uint32_t(all.size()))) continue;
    const std::string_view wanted = unit_of_scalar(key, s, is_prismatic);
    const auto found = conversion(unit, v.is_relative, wanted);
    if (!found)
      throw Error(about + "its unit is " + quote(v.unit) + ", and that is in " + quote(wanted) +
                  (unit.base ? "" : "; the model description does not say what its unit is (<BaseUnit>)"));
    all[s] = *found;
  }
  if (std::all_of(all.begin(), all.end(), [](const Conversion& c) { return c.is_identity(); })) all.clear();
  return all;
}

}  // namespace muro::fmu
