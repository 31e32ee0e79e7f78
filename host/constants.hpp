// SPDX-License-Identifier: MIT
// Constant properties of a world.
#pragma once

#include "core/world.hpp"

namespace muro::host {

/// The elements of an array; none when there is no such constant.
template <class T>
std::span<const T> constants(const World& world, ObjectId object, const Key<T>& key) {
  const ArrayHeader found = world.store().constant(object, key);
  return {static_cast<const T*>(found.data), found.size};
}

/// A single value, or `default_value` when there is no such constant.
template <class T>
T constant(const World& world, ObjectId object, const Key<T>& key, const T& default_value) {
  const void* data = world.store().constant(object, key).data;
  return data ? *static_cast<const T*>(data) : default_value;
}

}  // namespace muro::host
