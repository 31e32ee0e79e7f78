// SPDX-License-Identifier: MIT
// Memory behind the handles of arrays, lists and sums.
#pragma once

#include <cstdint>

namespace muro {

/// Elements of an array property in memory.
struct ArrayHeader {
  void* data = nullptr;
  std::uint64_t size = 0;
  std::uint64_t element_size = 0;  ///< bytes from one element to the next
};

/// Elements of a list property in memory. The store owns the memory and lets it grow.
struct ListHeader {
  void* data = nullptr;
  std::uint64_t size = 0;
  std::uint64_t capacity = 0;
  void (*grow)(ListHeader*, std::uint64_t wanted) = nullptr;
  std::uint64_t element_size = 0;
  std::uint64_t revision = 0;  ///< counts how often the list was cleared
};

/// The slots of a sum property, in registration order.
struct SumHeader {
  const void* const* slots = nullptr;
  std::uint64_t size = 0;
};

}  // namespace muro
