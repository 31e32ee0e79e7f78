// SPDX-License-Identifier: MIT
// Names in messages.
#pragma once

#include <string>
#include <string_view>

namespace muro {

/// "`name`".
inline std::string quote(std::string_view name) { return "`" + std::string(name) + "`"; }

/// "`a`, `b`, `c`".
template <class Names>
std::string quoted_list(const Names& names) {
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + quote(name);
  return all;
}

}  // namespace muro
