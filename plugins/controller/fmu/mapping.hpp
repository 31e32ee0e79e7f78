// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model_description.hpp"
#include "plugins/controller/common/property_search/property_search.hpp"

namespace muro::fmu {

/// A reference to scalars of a property, as a scenario gives it; "[3]", "[0..2]" or "[vx]" behind it selects some.
struct Reference {
  PropertyReference property;
  std::optional<std::string> selection;
};

/// Connections of variables in a scenario, by index in the model description: "variable=reference,reference,...".
using Mapping = std::map<std::size_t, std::vector<Reference>>;

/// Reads the texts of parameter `parameter`, "inputs" or "outputs". Throws Error.
Mapping read_mapping(std::string_view parameter, std::span<const std::string_view> texts,
                     const ModelDescription& description);

/// Values that a scenario gives to variables before the initialization: "variable=value".
using StartValues = std::map<std::size_t, std::string>;

/// Reads the texts of parameter "parameters". Throws Error.
StartValues read_start_values(std::span<const std::string_view> texts, const ModelDescription& description);

/// Adjacent scalars of a property.
struct Place {
  FoundProperty property{};
  std::uint64_t first = 0;
  std::optional<std::uint64_t> count{};  ///< nothing: all from `first` on
};

/// Returns the scalars that references of a scenario name for a variable. Throws Error with the possible names.
std::vector<Place> places_of(const PropertySearch& search, std::span<const Reference> references, bool is_input,
                             std::string_view variable);
/// Returns the property with the name of a variable. An input gets the reading of the device (NAME.measured) when there
/// is one. Returns nothing when no object has it; throws Error when several objects have it.
std::optional<Place> place_of(const PropertySearch& search, std::string_view variable, bool is_input);

}  // namespace muro::fmu
