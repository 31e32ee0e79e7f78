// SPDX-License-Identifier: MIT
// Places of members in structs and of functions in interfaces, as numbers that two libraries can compare.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace muro::abi {

/// Place of a member in its struct, or alignment and size of the struct itself.
struct Place {
  std::string_view name;     ///< "Shape.size"; "Shape"
  std::uint32_t offset = 0;  ///< bytes; of a struct itself: its alignment
  std::uint32_t size = 0;    ///< bytes; 0: a struct that may grow
};

#define MURO_SIZE(STRUCT) \
  ::muro::abi::Place { #STRUCT, alignof(STRUCT), sizeof(STRUCT) }
#define MURO_GROWS(STRUCT) \
  ::muro::abi::Place { #STRUCT, alignof(STRUCT), 0 }
#define MURO_PLACE(STRUCT, MEMBER) \
  ::muro::abi::Place { #STRUCT "." #MEMBER, offsetof(STRUCT, MEMBER), sizeof(STRUCT::MEMBER) }  // NOLINT: of pointers

/// Adds a number to a hash (FNV-1a).
constexpr std::uint32_t add_to_layout(std::uint32_t hash, std::uint64_t number) {
  for (int byte = 0; byte < 8; ++byte) hash = (hash ^ std::uint32_t(number >> 8 * byte & 0xff)) * 16777619u;
  return hash;
}

/// The hash of a list of places: of their numbers, not of their names.
constexpr std::uint32_t layout_of(std::span<const Place> places) {
  std::uint32_t hash = 2166136261u;
  for (const Place& p : places) hash = add_to_layout(add_to_layout(hash, p.offset), p.size);
  return hash;
}

/// The place of a virtual function in the table of its class, in bytes (Itanium C++ ABI, section 2.3).
template <class Function>
std::uint64_t virtual_place(Function function) {
  static_assert(sizeof function == 2 * sizeof(std::uintptr_t), "not a pointer to a member function");
  std::uintptr_t words[2];
  std::memcpy(words, &function, sizeof words);
#if defined(__aarch64__) || defined(__arm__)
  return words[0];  // the other word says that it is virtual
#else
  return words[0] - 1;
#endif
}

/// Has one more virtual function than `Interface`, whose place is the number of functions of `Interface`.
template <class Interface>
class OneMore : public Interface {
 public:
  virtual void one_more();

 protected:
  ~OneMore() = default;
};

/// The stamp of an extension: a hash of the places of its structs and functions, and of their number.
template <class Interface, class... Functions>
std::uint32_t extension_layout(std::span<const Place> structs, Functions... functions) {
  std::uint32_t hash = layout_of(structs);
  ((hash = add_to_layout(hash, virtual_place(functions))), ...);
  return add_to_layout(hash, virtual_place(&OneMore<Interface>::one_more));
}

}  // namespace muro::abi
