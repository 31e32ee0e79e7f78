// SPDX-License-Identifier: MIT
// Lists of names in messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muro::host {

/// Returns "a, b, c"; for very many names only the first ones, "a, b and 7 more".
std::string comma_separated(const std::vector<std::string>& names);

/// Returns the text after a name that is not among `names`: " (did you mean `x`?); there are: a, b". `intro` comes
/// before the list; without names the result is empty.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names,
                       std::string_view intro = "there are");

/// Returns "1 robot", "2 robots".
std::string plural(std::size_t count, std::string_view noun);

}  // namespace muro::host
