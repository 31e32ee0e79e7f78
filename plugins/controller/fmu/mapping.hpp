// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model_description.hpp"
#include "muro/connector.hpp"

namespace muro::fmu {

/// How a scenario refers to scalars of a property: "property", "object:property", and "[3]", "[0..2]" or "[vx]" behind
/// it for some of them.
struct Reference {
  std::string object;  ///< empty: it is searched for
  std::string property;
  std::optional<std::string> selection;
};

/// What a scenario says about variables, by their place in the model description: "variable=reference,reference,...".
using Mapping = std::map<std::size_t, std::vector<Reference>>;

/// Reads the texts of parameter `parameter`, "inputs" or "outputs". Throws Error.
Mapping read_mapping(std::string_view parameter, std::span<const std::string_view> texts,
                     const ModelDescription& description);

/// Values that a scenario gives to variables before the initialization: "variable=value".
using StartValues = std::map<std::size_t, std::string>;

/// Reads the texts of parameter "parameters". Throws Error.
StartValues read_start_values(std::span<const std::string_view> texts, const ModelDescription& description);

/// Scalars of a property, one behind the other.
struct Place {
  FoundProperty property;
  std::uint64_t first = 0;
  std::optional<std::uint64_t> count;  ///< nothing: all from `first` on
};

/// Finds what the variables of an FMU stand for, for one item.
class PropertySearch {
 public:
  PropertySearch(const Connector& connector, const Item& item);

  /// The scalars that references of a scenario name. Throws Error, which names what there is.
  std::vector<Place> places(std::span<const Reference> references) const;
  /// The property with the name of a variable: on the object of the item, else on the base, else on the only other
  /// object of the robot that has it, else on the world; for an input NAME.measured of the same object where there is
  /// one. Nothing where there is none; throws Error where several have it.
  std::optional<Place> place_of(std::string_view variable, bool is_input) const;

  /// "rover_1/base_link:twist", for messages.
  std::string name_of(const FoundProperty& property) const;

 private:
  Place place_of(const Reference& reference) const;
  std::optional<FoundProperty> anywhere(std::string_view property) const;
  ObjectId object(std::string_view name) const;
  const FoundProperty* property_of(ObjectId object, std::string_view name) const;
  std::string local_name(ObjectId object) const;
  std::string owner() const;

  const Connector& connector_;
  Item item_;
  std::vector<ObjectId> objects_;  ///< in the order of search; all after the first `preferred_` are equal
  std::size_t preferred_ = 0;
};

}  // namespace muro::fmu
