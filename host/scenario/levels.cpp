// SPDX-License-Identifier: MIT
#include "host/scenario/levels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"
#include "host/scenario/map_reader.hpp"
#include "host/scenario/subsystem_reader.hpp"

namespace muro::host {

namespace {

/// Returns the motions, in the order of their levels; `names` gets the names of the levels.
std::vector<Subsystem> read_motions(const std::string& name, const Node& levels, const std::string& owner,
                                    const std::string& what, std::vector<std::string>& names, Problems& problems) {
  std::vector<Subsystem> all;
  for (std::size_t i = 0; i < levels.map.size(); ++i) {
    const auto& [level, node] = levels.map[i];
    const Location& at = levels.key_locations[i];
    if (node.is_off() || !check_name(level, at, "a level", problems)) continue;
    if (!is_subsystem(node)) {
      problems.add(at, fmt::format("level `{}` of {} needs `use: NAME` of a motion", level, what));
      continue;
    }
    names.push_back(level);
    all.push_back(read_subsystem(name + "." + level, node, owner, problems));
  }
  return all;
}

/// Default rates (Hz) of level.rules. With `dwell` only, it is the fastest rate at which a controller may write
/// `motion.level.target`, because `dwell` counts from the run that sees a change.
constexpr double rules_rate = 100, dwell_rate = 1000;

/// Returns the algorithm that chooses the level, or makes it stay for a while.
Subsystem read_rules(const std::string& name, MapReader& map) {
  Subsystem s;
  s.name = name + ".rules";
  const bool has_rules = map.has("rules");
  s.location = map.find(has_rules ? "rules" : "dwell")->location;
  s.rate = map.number("rules_rate", has_rules ? rules_rate : dwell_rate, 1e-3, 1e6);
  std::vector<std::string> rules;
  if (has_rules)
    for (const Node& e : map.list("rules").list) rules.push_back(e.scalar);
  const bool by_run_speed = std::any_of(rules.begin(), rules.end(), [](const std::string& rule) {
    return rule.find(" when slower ") != rule.npos || rule.find(" when faster ") != rule.npos;
  });
  s.use = by_run_speed ? "level.budget" : "level.rules";
  s.parameters["rules"] = std::move(rules);
  if (map.has("dwell")) s.parameters["dwell"] = map.number("dwell", 0.1, 0, 1e6);
  return s;
}

}  // namespace

bool has_levels(const Node& node) { return node.kind == Node::Kind::map && node.find("levels") != nullptr; }

std::vector<Subsystem> read_levels(const std::string& name, const Node& node, const std::string& owner,
                                   Problems& problems) {
  const std::string what = fmt::format("`{}` of {}", name, owner);
  MapReader map(node, what, problems);
  HandoverLevel level;
  std::vector<Subsystem> all = read_motions(name, map.map("levels"), owner, what, level.names, problems);
  if (all.size() < 2)
    problems.add(node.location,
                 fmt::format("{} lists {} levels; list two or more, or write `use: NAME` instead of `levels`", what,
                             all.size()));
  const std::string start = map.text("start", level.names.empty() ? "" : level.names.front());
  const auto found = std::find(level.names.begin(), level.names.end(), start);
  if (found == level.names.end() && !level.names.empty())
    map.problem("start", fmt::format("is `{}`, but there is no such level{}", start, suggestion(start, level.names)));
  else
    level.start = std::uint32_t(found - level.names.begin());
  for (std::size_t i = 0; i < all.size(); ++i) {
    level.index = std::uint32_t(i);
    all[i].level = level;
  }
  if (map.has("rules") || map.has("dwell")) all.push_back(read_rules(name, map));
  map.reject_unknown_keys();
  return all;
}

}  // namespace muro::host
