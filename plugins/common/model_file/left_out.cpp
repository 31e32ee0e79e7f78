// SPDX-License-Identifier: MIT
#include "left_out.hpp"

#include <algorithm>
#include <utility>

namespace muro::model_file {

void LeftOut::add(Severity severity, const std::string& element, const std::string& reason, FileLocation at) {
  auto same = std::find_if(kinds_.begin(), kinds_.end(),
                           [&](const Kind& k) { return k.element == element && k.reason == reason; });
  if (same == kinds_.end()) same = kinds_.insert(kinds_.end(), {severity, element, reason, {}});
  same->locations.push_back(std::move(at));
}

void LeftOut::report(Problems& problems) {
  constexpr std::size_t max = 8;
  for (const auto& [severity, element, reason, locations] : std::exchange(kinds_, {})) {
    std::string also;
    for (std::size_t i = 1; i < std::min(locations.size(), max); ++i)
      also += (i > 1 ? ", " : "") + concat(locations[i].line);
    if (locations.size() > max) also += concat(" and ", locations.size() - max, " more");
    if (!also.empty()) also = concat(locations.size() > 2 ? " (also in lines " : " (also in line ", also, ")");
    problems.report(severity, locations.front(), concat(element, " is left out", also, ": ", reason));
  }
}

}  // namespace muro::model_file
