// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace muro {

/// The candidate most like `wrong` (edit distance with transpositions), or "" when none is near.
std::string nearest(std::string_view wrong, std::span<const std::string> candidates);

/// " (did you mean `x`?)", or "" when none is near.
std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

}  // namespace muro
