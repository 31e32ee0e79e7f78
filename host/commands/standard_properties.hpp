// SPDX-License-Identifier: MIT
// The properties of sdk/muro/vocabulary/ as a table.
#pragma once

#include <span>
#include <string_view>

#include "muro/key.hpp"

namespace muro::host {

/// Standard properties of one kind of object.
struct PropertyGroup {
  std::string_view title;   ///< "Joints"
  std::string_view object;  ///< a sentence: which object has them
  std::span<const KeyInfo* const> keys;
};

/// All groups, in the order of the vocabulary.
std::span<const PropertyGroup> standard_properties();

}  // namespace muro::host
