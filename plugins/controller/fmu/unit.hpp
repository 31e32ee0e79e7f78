// SPDX-License-Identifier: MIT
// Units of FMUs and of properties, and how numbers go from one to the other.
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

/// A unit in terms of base units: a number in base units is factor * number + offset.
struct BaseUnit {
  Exponents exponents{};
  double factor = 1;
  double offset = 0;
};

/// A unit of a model description: its name, and what it means where the model description says so.
struct Unit {
  std::string name;
  std::optional<BaseUnit> base;
};

/// From the number of an FMU to that of a property, and back.
struct Conversion {
  double factor = 1;
  double offset = 0;

  bool is_identity() const { return factor == 1 && offset == 0; }
  double to_property(double number) const { return is_identity() ? number : factor * number + offset; }
  double to_fmu(double number) const { return is_identity() ? number : (number - offset) / factor; }
};

/// The exponents of a product of SI units such as "kg m^2", "m/s" or "N.m"; nothing when a part of it is not known.
std::optional<Exponents> exponents_of(std::string_view unit);

/// The unit of one scalar of a property: "m/s" of the first of a twist, whose unit is "m/s, rad/s". `is_prismatic`: the
/// property is of a prismatic joint, so "rad or m" is m.
std::string_view unit_of_scalar(const KeyInfo& key, std::uint32_t scalar, bool is_prismatic);

/// Nothing when the units differ in what they measure. `is_relative`: a difference, so the offset does not count.
std::optional<Conversion> conversion(const Unit& of_fmu, bool is_relative, std::string_view of_property);

}  // namespace muro::fmu
