// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace muro::scanner {

/// Returns the first `size` elements of `memory`, which grows if needed and never shrinks: no allocation after warm-up.
template <class T>
std::span<T> scratch(std::vector<T>& memory, std::size_t size) {
  if (memory.size() < size) memory.resize(size);
  return {memory.data(), size};
}

}  // namespace muro::scanner
