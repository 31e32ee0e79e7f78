// SPDX-License-Identifier: MIT
#include "start_values.hpp"

#include <algorithm>
#include <cstring>

#include "muro/algorithm.hpp"
#include "number.hpp"
#include "plugins/common/text/quote.hpp"
#include "value_text.hpp"

namespace muro::fmu {

namespace {

std::string about_value(const Variable& v, const std::string& text) {
  return "`parameters`: value " + quote(text) + " of " + quote(v.name) + " ";
}

std::vector<std::byte> start_numbers(const Variable& v, const std::string& text, int version) {
  std::vector<std::byte> bytes;
  if (const std::string problem = read_numbers(v, text, version, bytes); !problem.empty())
    throw Error(about_value(v, text) + problem);
  return bytes;
}

void set_start_value(Component& component, const Variable& v, const std::string& text, int version) {
  if (v.type == Type::binary) {
    const auto bytes = bytes_of_hexadecimal(text);
    if (!bytes) throw Error(about_value(v, text) + std::string(is_no_hexadecimal));
    return component.set_bytes(v.reference, *bytes);
  }
  if (v.type == Type::string && v.size == 1) return component.set_text(v.reference, text);
  if (v.type == Type::string) throw Error(about_value(v, text) + "cannot be given: it is an array of texts");
  const std::vector<std::byte> numbers = start_numbers(v, text, version);
  if (v.size > 0) component.set(v.type, std::span(&v.reference, 1), numbers.data(), v.size);
}

}  // namespace

void set_sizes(ModelDescription& d, const StartValues& values) {
  for (const auto& value_of : values) {
    const std::size_t variable = value_of.first;
    const std::string& text = value_of.second;
    if (!d.is_length(variable)) continue;
    const Variable& v = d.variables[variable];
    const std::vector<std::byte> number = start_numbers(v, text, d.version);
    const bool fits = with_fmi_type(v.type, d.version, [&](auto zero) {
      auto value = zero;
      std::uint64_t length = 0;
      std::memcpy(&value, number.data(), sizeof value);
      return convert(value, length) && d.set_length(variable, length);
    });
    if (!fits)
      throw Error(about_value(v, text) + "is no length of arrays: each has at most " + std::to_string(largest_array) +
                  " elements");
  }
}

void set_start_values(Component& component, const ModelDescription& d, const StartValues& values) {
  const auto is_structural = [&](const auto& value) {
    return d.variables[value.first].causality == Causality::structural_parameter;
  };
  const auto set_those = [&](bool structural) {
    for (const auto& value : values)
      if (is_structural(value) == structural)
        set_start_value(component, d.variables[value.first], value.second, d.version);
  };
  if (std::any_of(values.begin(), values.end(), is_structural)) {
    component.enter_configuration();
    set_those(true);
    component.exit_configuration();
  }
  set_those(false);
}

}  // namespace muro::fmu
