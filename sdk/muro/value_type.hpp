// SPDX-License-Identifier: MIT
// What the value of a property is made of, in a form that any library reads without RTTI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "muro/geometry.hpp"

namespace muro {

/// The number type that a value is made of. `opaque` values have no columns, so they are not recorded; as state they
/// are saved and hashed byte by byte and must have no padding. `transient` values also hold addresses: a snapshot does
/// not have them.
enum class Scalar : std::uint8_t { f64, f32, i64, i32, u64, u32, u8, opaque, transient };

/// Identity and layout of a value type. Two libraries mean the same type when name, size and alignment agree; the size
/// of a type that grows may differ.
struct ValueType {
  std::string_view name;
  std::uint32_t size = 0;
  std::uint32_t align = 0;
  Scalar scalar = Scalar::opaque;
  std::span<const std::string_view> labels{};  ///< one a scalar; empty for a single scalar
  bool grows = false;  ///< later minor versions of the SDK have more members at its end: see MURO_GROWING_TYPE

  constexpr std::uint32_t scalars() const { return labels.empty() ? 1u : std::uint32_t(labels.size()); }
  friend bool operator==(const ValueType& a, const ValueType& b) {
    return a.name == b.name && a.align == b.align && a.grows == b.grows && (a.size == b.size || a.grows);
  }
};

/// Bytes in one scalar; 0 for opaque values.
constexpr std::size_t size_of(Scalar s) {
  switch (s) {
    case Scalar::f64:
    case Scalar::i64:
    case Scalar::u64:
      return 8;
    case Scalar::f32:
    case Scalar::i32:
    case Scalar::u32:
      return 4;
    case Scalar::u8:
      return 1;
    default:
      return 0;
  }
}

/// Specialise for every type that a property can hold: `name`, `scalar`, and `labels` when it has
/// more than one scalar. The type must be copyable byte by byte.
template <class T>
struct ValueTraits;

/// Declares a value type made of equal scalars without padding.
#define MURO_VALUE_TYPE(TYPE, NAME, KIND, LABELS)                      \
  template <>                                                          \
  struct ValueTraits<TYPE> {                                           \
    static constexpr std::string_view name = NAME;                     \
    static constexpr Scalar scalar = Scalar::KIND;                     \
    static constexpr std::span<const std::string_view> labels{LABELS}; \
  };                                                                   \
  static_assert(sizeof(TYPE) == size_of(Scalar::KIND) * std::size(LABELS), "a value type has no padding")

/// Declares a struct of the SDK that may grow at its end. Properties of this type are constants; the host fills members
/// that the maker of a value does not know with their default values.
#define MURO_GROWING_TYPE(TYPE, NAME)                            \
  template <>                                                    \
  struct ValueTraits<TYPE> {                                     \
    static constexpr std::string_view name = NAME;               \
    static constexpr Scalar scalar = Scalar::opaque;             \
    static constexpr std::span<const std::string_view> labels{}; \
    static constexpr bool grows = true;                          \
  }

/// Declares a value type without columns (see Scalar): KIND is `opaque` or `transient`.
#define MURO_OPAQUE_TYPE(TYPE, NAME, KIND)                       \
  template <>                                                    \
  struct ValueTraits<TYPE> {                                     \
    static constexpr std::string_view name = NAME;               \
    static constexpr Scalar scalar = Scalar::KIND;               \
    static constexpr std::span<const std::string_view> labels{}; \
  }

/// A type that MURO_GROWING_TYPE declares.
template <class T>
concept GrowingType = requires {
  ValueTraits<T>::grows;
};

/// The ValueType of a type with traits.
template <class T>
inline constexpr ValueType value_type{ValueTraits<T>::name,   sizeof(T),     alignof(T), ValueTraits<T>::scalar,
                                      ValueTraits<T>::labels, GrowingType<T>};

}  // namespace muro

#include "muro/detail/standard_types.hpp"
