// SPDX-License-Identifier: MIT
#include "host/scenario/levels.hpp"

#include <algorithm>

#include "host/scenario/robot.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

bool has_levels(const Node& n) { return n.kind == Node::Kind::map && n.find("levels") != nullptr; }

std::vector<Subsystem> read_levels(const std::string& name, const Node& n, const std::string& owner,
                                   Problems& problems) {
  const std::string what = "`" + name + "` of " + owner;
  Section s(n, what, problems);
  const Node& levels = s.map("levels");
  std::vector<Subsystem> all;
  LevelChoice choice;
  for (std::size_t i = 0; i < levels.map.size(); ++i) {
    const auto& [level, node] = levels.map[i];
    if (node.is_off() || !check_name(level, levels.key_locations[i], "a level", problems)) continue;
    if (!is_subsystem(node)) {
      problems.add(levels.key_locations[i], "level `" + level + "` of " + what + " needs `use: NAME` of a motion");
      continue;
    }
    choice.names.push_back(level);
    all.push_back(read_subsystem(name + "." + level, node, owner, problems));
  }
  if (all.size() < 2)
    problems.add(n.location, what + " lists " + std::to_string(all.size()) +
                                 " levels; list two or more, or write `use: NAME` instead of `levels`");
  const std::string start = s.text("start", choice.names.empty() ? "" : choice.names.front());
  const auto found = std::find(choice.names.begin(), choice.names.end(), start);
  if (found == choice.names.end() && !choice.names.empty())
    s.problem("start", "is `" + start + "`, but there is no such level" + did_you_mean(start, choice.names) +
                           "; there are: " + listed(choice.names));
  else
    choice.start = std::uint32_t(found - choice.names.begin());
  for (std::size_t i = 0; i < all.size(); ++i) {
    choice.number = std::uint32_t(i);
    all[i].level = choice;
  }

  if (const Node* rules = s.find("rules")) {
    Subsystem r;
    r.name = name + ".rules";
    r.use = "level.rules";
    r.location = rules->location;
    r.rate = s.number("rules_rate", 100, 1e-3, 1e6);
    std::vector<std::string> texts;
    for (const Node& e : s.list("rules").list) texts.push_back(e.scalar);
    r.parameters["rules"] = std::move(texts);
    if (s.has("dwell")) r.parameters["dwell"] = s.number("dwell", 0.1, 0, 1e6);
    all.push_back(std::move(r));
  }
  s.close();
  return all;
}

}  // namespace muro::host
