// SPDX-License-Identifier: MIT
// Texts of messages about model files.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

#include "plugins/common/text/quote.hpp"

namespace muro::model_file {

/// Returns the shortest text that reads back as `number`, with a decimal point in every locale.
inline std::string shortest(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// Joins texts and numbers, one after the other.
template <class... Values>
std::string concat(const Values&... values) {
  std::string result;
  const auto add = [&result](const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<T>)
      result += shortest(value);
    else if constexpr (std::is_integral_v<T>)
      result += std::to_string(value);
    else
      result += value;
  };
  (add(values), ...);
  return result;
}

}  // namespace muro::model_file
