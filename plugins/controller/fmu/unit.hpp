// SPDX-License-Identifier: MIT
// Units of FMUs and of properties, and conversion between them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::fmu {

/// Exponents of kg, m, s, A, K, mol, cd and rad.
using Exponents = std::array<int, 8>;
inline constexpr std::array<std::string_view, 8> base_unit_names{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};

/// A unit in terms of base units: the value in base units is factor * number + offset.
struct BaseUnit {
  Exponents exponents{};
  double factor = 1;
  double offset = 0;
};

/// A unit of a model description: its name, and its definition if the model description has one.
struct Unit {
  std::string name;
  std::optional<BaseUnit> base;
};

/// Conversion from a number of an FMU to a number of a property, and back.
struct Conversion {
  double factor = 1;
  double offset = 0;

  bool is_identity() const { return factor == 1 && offset == 0; }
  double to_property(double number) const { return is_identity() ? number : factor * number + offset; }
  double to_fmu(double number) const { return is_identity() ? number : (number - offset) / factor; }
};

/// Returns the exponents of a product of SI units such as "kg m^2", "m/s" or "N.m"; nothing when a part is unknown.
std::optional<Exponents> exponents_of(std::string_view unit);

/// Returns the unit of one scalar of a property: "m/s" for the first scalar of a twist, which is in "m/s, rad/s".
/// `is_prismatic`: the property belongs to a prismatic joint, so "rad or m" is m.
std::string_view unit_of_scalar(const KeyInfo& key, std::uint32_t scalar, bool is_prismatic);

/// Returns nothing when the units measure different quantities. `is_relative`: a difference, so the offset is not used.
std::optional<Conversion> conversion(const Unit& of_fmu, bool is_relative, std::string_view of_property);

}  // namespace muro::fmu
