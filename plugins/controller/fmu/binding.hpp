// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>

#include "exchange.hpp"
#include "mapping.hpp"

namespace muro::fmu {

/// Connects the variables of an FMU with the properties of one robot after the other. [setup]
class Binder {
 public:
  /// `has_value`: whether an input, by its index in the model description, needs no property.
  Binder(Connector& connector, const ModelDescription& description, const Mapping& inputs, const Mapping& outputs,
         std::function<bool(std::size_t)> has_value)
      : connector_(connector),
        of_robots_(connector),
        description_(description),
        inputs_(inputs),
        outputs_(outputs),
        has_value_(std::move(has_value)) {}

  /// Adds the variables of an item to the exchanges. Throws Error when an input is not connected, and when sizes, units
  /// or types do not fit.
  void bind(const Item& item, Exchange& inputs, Exchange& outputs);

 private:
  void join(const PropertySearch& search, const Variable& variable, std::span<const Place> places, bool is_input,
            Exchange& exchange);
  Run run_of(const PropertySearch& search, const Variable& variable, const Place& place, bool is_input);
  std::vector<Conversion> conversions(const PropertySearch& search, const Variable& variable, const Place& place,
                                      const std::string& about) const;

  struct Binding {
    ObjectId object;
    std::string key;
    bool is_input;
    auto operator<=>(const Binding&) const = default;
  };

  Connector& connector_;
  RobotObjects of_robots_;
  const ModelDescription& description_;
  const Mapping& inputs_;
  const Mapping& outputs_;
  std::function<bool(std::size_t)> has_value_;
  std::map<Binding, void*> handles_;  ///< connected properties; each is bound once
};

}  // namespace muro::fmu
