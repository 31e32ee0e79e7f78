// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace muro::scanner {

/// The first `size` elements of memory that grows when it has to and never shrinks: once warm, nothing is allocated.
template <class T>
std::span<T> scratch(std::vector<T>& memory, std::size_t size) {
  if (memory.size() < size) memory.resize(size);
  return {memory.data(), size};
}

}  // namespace muro::scanner
