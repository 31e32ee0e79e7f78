// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "muro/key.hpp"

namespace muro {

/// Values of a property in the types of this host. A plugin of an older SDK has shorter elements of a type that grows
/// (MURO_GROWING_TYPE): their other members get default values.
class OwnValues {
 public:
  /// `data`: `count` elements, which outlive this; none where only the key is needed.
  OwnValues(const KeyInfo& key, const void* data, std::uint32_t count);
  OwnValues(const OwnValues&) = delete;
  OwnValues& operator=(const OwnValues&) = delete;

  /// Whether this host knows a type that grows.
  static bool knows(const ValueType& type);

  const KeyInfo& key() const { return key_; }
  const void* data() const { return data_; }

 private:
  KeyInfo key_;
  const void* data_;
  std::vector<std::byte> copy_;
};

}  // namespace muro
