// SPDX-License-Identifier: MIT
// Constants of a world that is built.
#pragma once

#include "core/world.hpp"

namespace muro::host {

/// The elements of an array; none where there is no such constant.
template <class T>
std::span<const T> constants(const World& world, ObjectId object, const Key<T>& key) {
  const ArrayHeader found = world.store().constant(object, key);
  return {static_cast<const T*>(found.data), found.size};
}

/// A single value, whose size tells nothing.
template <class T>
T constant(const World& world, ObjectId object, const Key<T>& key, const T& otherwise) {
  const void* data = world.store().constant(object, key).data;
  return data ? *static_cast<const T*>(data) : otherwise;
}

}  // namespace muro::host
