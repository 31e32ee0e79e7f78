// SPDX-License-Identifier: MIT
// Numbers of FMUs and of properties. Their types are known only at run time.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "model_description.hpp"

namespace muro::fmu {

/// Calls `visit` with a 0 of the C type that FMI uses for numbers of a type: `[&](auto zero) { ... }`.
template <class Visit>
auto with_fmi_type(Type type, int version, Visit visit) {
  switch (type) {
    case Type::float32:
      return visit(float{});
    case Type::int64:
      return visit(std::int64_t{});
    case Type::uint64:
      return visit(std::uint64_t{});
    case Type::int32:
      return visit(std::int32_t{});
    case Type::uint32:
      return visit(std::uint32_t{});
    case Type::int16:
      return visit(std::int16_t{});
    case Type::uint16:
      return visit(std::uint16_t{});
    case Type::int8:
      return visit(std::int8_t{});
    case Type::uint8:
      return visit(std::uint8_t{});
    case Type::boolean:
      return version == 2 ? visit(std::int32_t{}) : visit(std::uint8_t{});
    case Type::enumeration:
      return version == 2 ? visit(std::int32_t{}) : visit(std::int64_t{});
    case Type::float64:
    case Type::string:
    case Type::binary:
      break;  // these two types have their own functions
  }
  return visit(double{});
}

/// Converts `value` to another type; rounds to integers. Returns false when it does not fit.
template <class From, class To>
bool convert(From value, To& result) {
  if constexpr (std::is_integral_v<From> && std::is_integral_v<To>) {
    result = To(value);
    return std::in_range<To>(value);
  } else if constexpr (std::is_integral_v<To>) {
    const double whole = std::nearbyint(double(value));
    // 2^digits is the first number above the largest, and exact as a double
    if (!(whole >= double(std::numeric_limits<To>::min()) && whole < std::ldexp(1.0, std::numeric_limits<To>::digits)))
      return false;
    result = To(whole);
    return true;
  } else {
    result = To(value);
    return std::isfinite(result) || !std::isfinite(double(value));
  }
}

template <class T>
std::string text_of_number(T value) {
  if constexpr (std::is_integral_v<T>) return std::to_string(value);
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", double(value));
  return text;
}

}  // namespace muro::fmu
