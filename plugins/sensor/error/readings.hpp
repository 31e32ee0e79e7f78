// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "muro/connector.hpp"
#include "part.hpp"
#include "settings.hpp"

namespace muro {

/// Whether sensor.error can process a property: f64 numbers, alone, in an array or in a value, arrays of f32, and lists
/// of neighbours.
bool is_reading(const FoundProperty& property);
ReadingShape shape_of(const FoundProperty& property);

/// Returns the reading of this name. Throws muro::Error if it is missing or does not consist of real numbers. [setup]
FoundProperty find_reading(const Connector& c, ObjectId object, std::string_view name);
/// Returns the readings of an object that a part knows. Throws muro::Error if there are none. [setup]
std::vector<FoundProperty> readings_of_part(const Connector& c, ObjectId object, const Part& part);
/// Returns the property of this name and of type T, if the object has it. [setup]
template <class T>
std::optional<FoundProperty> find_value(const Connector& c, ObjectId object, std::string_view name) {
  for (const FoundProperty& p : c.properties(object))
    if (p.key->name == name && p.multiplicity == Multiplicity::single && *p.key->type == value_type<T>) return p;
  return std::nullopt;
}
}  // namespace muro
