// SPDX-License-Identifier: MIT
#include "host/scenario/problems.hpp"

#include <fmt/format.h>

#include <sstream>

#include "core/error.hpp"
#include "host/names.hpp"
#include "muro/base/printable.hpp"

namespace muro::host {

void Problems::add(std::string line) {
  line = printable(line);
  if (known_.insert(line).second && lines_.size() < most_shown) lines_.push_back(std::move(line));
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
  if (lines_.empty()) return;
  std::vector<std::string> lines = lines_;
  if (known_.size() > lines.size()) lines.push_back(fmt::format("and {} more", known_.size() - lines.size()));
  throw SetupError(lines);
}

bool check_name(const std::string& name, const Location& at, const std::string& what, Problems& problems) {
  constexpr std::size_t longest = 255;
  const bool valid = name.find_first_of("/: \t\n\v\f\r") == name.npos && printable(name) == name;
  if (!name.empty() && name.size() <= longest && valid) return true;
  if (name.size() > longest)
    problems.add(at, fmt::format("a name of {} bytes cannot be that of {}: at most {} are possible", name.size(), what,
                                 longest));
  else
    problems.add(at, fmt::format("{} cannot be the name of {}: a name is not empty and has no `/`, `:`, control "
                                 "characters or white space",
                                 in_backquotes(name), what));
  return false;
}

std::vector<UnknownSubsystem> unknown_switched_off(const Node& map, const std::vector<std::string>& names,
                                                   const std::string& what) {
  std::vector<UnknownSubsystem> unknown;
  const std::unordered_set<std::string> known(names.begin(), names.end());
  for (std::size_t i = 0; i < map.map.size(); ++i) {
    const auto& [key, value] = map.map[i];
    if (!value.is_off() || value.replaces || value.empty || known.count(key) > 0) continue;
    unknown.push_back({key, map.key_locations[i],
                       fmt::format("nothing is named `{}` in {}, so it cannot be switched off{}", key, what,
                                   suggestion(key, names))});
  }
  return unknown;
}

void check_switched_off(const Node& map, const std::vector<std::string>& names, const std::string& what,
                        Problems& problems) {
  for (const UnknownSubsystem& u : unknown_switched_off(map, names, what)) problems.add(u.location, u.problem);
}

}  // namespace muro::host
