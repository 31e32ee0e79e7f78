// SPDX-License-Identifier: MIT
// Lists of names in messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muro::host {

/// "a, b, c"; of very many the first ones, "a, b and 7 more".
std::string comma_separated(const std::vector<std::string>& names);

/// What follows a name that is not among `names`: " (did you mean `x`?); there are: a, b". `intro` stands before the
/// list; without names the result is empty.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names,
                       std::string_view intro = "there are");

/// "1 robot", "2 robots".
std::string plural(std::size_t count, std::string_view noun);

}  // namespace muro::host
