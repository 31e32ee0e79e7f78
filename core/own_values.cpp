// SPDX-License-Identifier: MIT
#include "core/own_values.hpp"

#include <cstring>

#include "muro/rows.hpp"
#include "muro/shape.hpp"

namespace muro {

bool OwnValues::knows(const ValueType& type) { return type == value_type<Shape>; }

OwnValues::OwnValues(const KeyInfo& key, const void* data, std::uint32_t count) : key_(key), data_(data) {
  constexpr const ValueType* own = &value_type<Shape>;  // the only type that grows
  if (key.type->size == own->size || !(*key.type == *own)) return;
  key_.type = own;
  if (!data) return;
  copy_.resize(count * sizeof(Shape));
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto* const from = static_cast<const std::byte*>(data) + std::size_t(i) * key.type->size;
    const Shape shape = known_part<Shape>(from, key.type->size);
    std::memcpy(copy_.data() + i * sizeof(Shape), static_cast<const void*>(&shape), sizeof(Shape));
  }
  data_ = copy_.data();
}

}  // namespace muro
