// SPDX-License-Identifier: MIT
#include "host/names.hpp"

#include <fmt/format.h>

#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

std::string comma_separated(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names, std::string_view intro) {
  if (names.empty()) return "";
  return fmt::format("{}; {}: {}", did_you_mean(wrong, names), intro, fmt::join(names, ", "));
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace muro::host
