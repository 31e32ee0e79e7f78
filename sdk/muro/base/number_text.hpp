// SPDX-License-Identifier: MIT
// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace muro {

/// Returns a number with six significant digits: 0.05, 1e+308, 3.14159.
inline std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

}  // namespace muro
