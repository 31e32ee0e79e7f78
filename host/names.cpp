// SPDX-License-Identifier: MIT
#include "host/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "muro/base/did_you_mean.hpp"

namespace muro::host {

std::string comma_separated(const std::vector<std::string>& names) {
  constexpr std::size_t most = 60;
  const std::size_t shown = std::min(most, names.size());
  std::string all = fmt::format("{}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(shown), ", "));
  if (shown < names.size()) all += fmt::format(" and {} more", names.size() - shown);
  return all;
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names, std::string_view intro) {
  if (names.empty()) return "";
  return fmt::format("{}; {}: {}", did_you_mean(wrong, names), intro, comma_separated(names));
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace muro::host
