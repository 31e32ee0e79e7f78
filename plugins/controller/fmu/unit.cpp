// SPDX-License-Identifier: MIT
#include "unit.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

namespace muro::fmu {

namespace {

struct NamedUnit {
  std::string_view name;
  Exponents exponents;  // kg, m, s, A, K, mol, cd, rad
};
constexpr NamedUnit named_units[] = {
    {"1", {}},
    {"kg", {1}},
    {"m", {0, 1}},
    {"s", {0, 0, 1}},
    {"A", {0, 0, 0, 1}},
    {"K", {0, 0, 0, 0, 1}},
    {"mol", {0, 0, 0, 0, 0, 1}},
    {"cd", {0, 0, 0, 0, 0, 0, 1}},
    {"rad", {0, 0, 0, 0, 0, 0, 0, 1}},
    {"N", {1, 1, -2}},
    {"J", {1, 2, -2}},
    {"W", {1, 2, -3}},
    {"Pa", {1, -1, -2}},
    {"Hz", {0, 0, -1}},
    {"V", {1, 2, -3, -1}},
    {"T", {1, 0, -2, -1}},
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Splits "a, b" or "a or b" into pieces.
std::vector<std::string_view> pieces(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> found;
  for (std::size_t at; (at = text.find(separator)) != text.npos; text.remove_prefix(at + separator.size()))
    found.push_back(text.substr(0, at));
  found.push_back(text);
  return found;
}

}  // namespace

std::optional<Exponents> exponents_of(std::string_view unit) {
  Exponents all{};
  bool divides = false, any = false;
  while (!unit.empty()) {
    if (const char c = unit.front(); c == ' ' || c == '.' || c == '*' || c == '/') {
      divides = divides || c == '/';
      unit.remove_prefix(1);
      continue;
    }
    std::size_t length = 0;
    while (length < unit.size() && is_letter(unit[length])) ++length;
    if (length == 0 && unit.front() == '1') length = 1;
    const std::string_view name = unit.substr(0, length);
    const auto* const found = std::find_if(std::begin(named_units), std::end(named_units),
                                           [&](const NamedUnit& u) { return u.name == name; });
    if (found == std::end(named_units)) return std::nullopt;
    unit.remove_prefix(length);
    if (unit.starts_with('^')) unit.remove_prefix(1);
    int power = 1;
    const auto [end, code] = std::from_chars(unit.data(), unit.data() + unit.size(), power);
    if (code == std::errc()) unit.remove_prefix(std::size_t(end - unit.data()));
    if (code == std::errc::result_out_of_range || power > 100 || power < -100) return std::nullopt;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += (divides ? -power : power) * found->exponents[i];
    divides = false;
    any = true;
  }
  if (!any || divides) return std::nullopt;
  return all;
}

std::string_view unit_of_scalar(const KeyInfo& key, std::uint32_t scalar, bool is_prismatic) {
  const std::uint32_t count = key.type->scalars();
  scalar %= count;
  if (key.type->name == value_type<Pose>.name && scalar >= 3) return "1";  // a quaternion
  const std::vector<std::string_view> kinds = pieces(key.unit, " or ");
  if (kinds.size() == 2) return kinds[is_prismatic ? 1 : 0];
  const std::vector<std::string_view> parts = pieces(key.unit, ", ");
  if (parts.size() == 1) return key.unit;
  if (key.type->name == value_type<Inertia>.name && parts.size() == 3)
    return parts[scalar == 0 ? 0 : scalar < 4 ? 1 : 2];  // mass, centre of mass, moments
  return count % parts.size() == 0 ? parts[scalar / (count / parts.size())] : key.unit;
}

std::optional<Conversion> conversion(const Unit& of_fmu, bool is_relative, std::string_view of_property) {
  const std::optional<Exponents> wanted = exponents_of(of_property);
  const bool same_name = of_fmu.name == of_property;
  if (!of_fmu.base) {
    const std::optional<Exponents> own = exponents_of(of_fmu.name);
    if (same_name || (own && wanted && *own == *wanted)) return Conversion{};
    return std::nullopt;
  }
  // equal names are enough: some tools leave rad out of the exponents
  if (!same_name && (!wanted || of_fmu.base->exponents != *wanted)) return std::nullopt;
  return Conversion{of_fmu.base->factor, is_relative ? 0 : of_fmu.base->offset};
}

}  // namespace muro::fmu
