// SPDX-License-Identifier: MIT
// Settings of an algorithm: their descriptions and their values.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "muro/rows.hpp"

namespace muro {

enum class ParameterType : std::uint8_t { real, integer, boolean, text, reals, texts };

/// One parameter as its author describes it. Write it with the makers below:
/// `real("max_speed", "m/s", 2.0, "fastest commanded motion").between(0, 100)`. May grow at its end.
struct Parameter {
  std::string_view name;  ///< snake_case
  ParameterType type = ParameterType::real;
  std::string_view unit = "1";  ///< SI
  std::string_view doc{};
  bool is_required = false;
  bool tunable = false;       ///< may change while the simulation runs
  double default_number = 0;  ///< real, integer, boolean (0 or 1)
  std::string_view default_text{};
  std::span<const double> default_reals{};
  double min = -std::numeric_limits<double>::infinity();  ///< allowed range, both ends included
  double max = std::numeric_limits<double>::infinity();
  std::uint32_t length = 0;                     ///< reals: how many; 0 for any number
  std::span<const std::string_view> choices{};  ///< text: the allowed words; empty for any

  constexpr Parameter between(double low, double high) const {
    Parameter p = *this;
    p.min = low;
    p.max = high;
    return p;
  }
  constexpr Parameter required() const {
    Parameter p = *this;
    p.is_required = true;
    return p;
  }
  constexpr Parameter of_length(std::uint32_t n) const {
    Parameter p = *this;
    p.length = n;
    return p;
  }
  constexpr Parameter one_of(std::span<const std::string_view> words) const {
    Parameter p = *this;
    p.choices = words;
    return p;
  }
};

constexpr Parameter real(std::string_view name, std::string_view unit, double default_value, std::string_view doc) {
  return {.name = name, .type = ParameterType::real, .unit = unit, .doc = doc, .default_number = default_value};
}
constexpr Parameter integer(std::string_view name, std::int64_t default_value, std::string_view doc) {
  return {.name = name, .type = ParameterType::integer, .doc = doc, .default_number = double(default_value)};
}
constexpr Parameter boolean(std::string_view name, bool default_value, std::string_view doc) {
  return {.name = name, .type = ParameterType::boolean, .doc = doc, .default_number = default_value ? 1.0 : 0.0};
}
constexpr Parameter text(std::string_view name, std::string_view default_value, std::string_view doc) {
  return {.name = name, .type = ParameterType::text, .doc = doc, .default_text = default_value};
}
constexpr Parameter reals(std::string_view name, std::string_view unit, std::span<const double> default_value,
                          std::string_view doc) {
  return {.name = name, .type = ParameterType::reals, .unit = unit, .doc = doc, .default_reals = default_value};
}
constexpr Parameter texts(std::string_view name, std::string_view doc) {
  return {.name = name, .type = ParameterType::texts, .doc = doc};
}

/// The value of one parameter; the parameter's type says which member holds it. May grow at its end.
struct ParameterValue {
  std::string_view name;
  double number = 0;
  std::string_view text;
  std::span<const double> reals;
  std::span<const std::string_view> texts;
  bool given = false;  ///< set by the user, not the default
};

/// All parameters of an algorithm, checked against its description: every described name is there.
class Parameters {
 public:
  Parameters() = default;
  explicit Parameters(const Rows<ParameterValue>& values) : values_(values) {}

  double real(std::string_view name) const { return at(name).number; }
  std::int64_t integer(std::string_view name) const { return std::int64_t(at(name).number); }
  bool boolean(std::string_view name) const { return at(name).number != 0; }
  std::string_view text(std::string_view name) const { return at(name).text; }
  std::span<const double> reals(std::string_view name) const { return at(name).reals; }
  std::span<const std::string_view> texts(std::string_view name) const { return at(name).texts; }
  bool given(std::string_view name) const { return at(name).given; }

 private:
  const ParameterValue& at(std::string_view name) const {
    for (const ParameterValue& v : values_)
      if (v.name == name) return v;
    throw std::logic_error("parameter `" + std::string(name) + "` is not in the algorithm's description");
  }
  Rows<ParameterValue> values_;
};

}  // namespace muro
