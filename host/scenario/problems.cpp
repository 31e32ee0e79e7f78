// SPDX-License-Identifier: MIT
#include "host/scenario/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/error.hpp"
#include "host/names.hpp"

namespace muro::host {

void Problems::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
}

bool Problems::collect(const std::string& prefix, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const SetupError& e) {
    std::istringstream lines(e.what());
    for (std::string line; std::getline(lines, line);) add(prefix + line);
    return false;
  }
}

void Problems::check() const {
  if (!lines_.empty()) throw SetupError(lines_);
}

bool check_name(const std::string& name, const Location& at, const std::string& what, Problems& problems) {
  const bool valid = !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '/' || c == ':' || std::isspace(c) || std::iscntrl(c);
  });
  if (!valid)
    problems.add(
        at, fmt::format("`{}` cannot be the name of {}: a name is not empty and has no `/`, `:` or white space", name,
                        what));
  return valid;
}

void check_switched_off(const Node& map, const std::vector<std::string>& names, const std::string& what,
                        Problems& problems) {
  for (std::size_t i = 0; i < map.map.size(); ++i) {
    const auto& [key, value] = map.map[i];
    if (!value.is_off() || value.replaces || value.empty) continue;
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    problems.add(map.key_locations[i], fmt::format("nothing is named `{}` in {}, so it cannot be switched off{}", key,
                                                   what, suggestion(key, names)));
  }
}

}  // namespace muro::host
