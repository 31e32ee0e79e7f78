// SPDX-License-Identifier: MIT
#include "tests/costs/budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace muro::costs {
namespace {

constexpr double least_part_of_scene = 0.01, least_part_of_plugin = 0.05;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::ifstream open(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return in;
}

SceneBudget scene_of(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, '|');) parts.push_back(trimmed(part));
  if (parts.size() < 4) throw std::runtime_error("`" + line + "` has no NAME | SCENARIO | WARM-UP | DURATION");
  SceneBudget scene{parts[0], parts[1], std::stod(parts[2]), std::stod(parts[3]), {}, {}};
  std::istringstream overrides(parts.size() > 4 ? parts[4] : "");
  for (std::string word; overrides >> word;) scene.overrides.push_back(word);
  return scene;
}

std::uint64_t total(const Costs& costs) {
  std::uint64_t sum = 0;
  for (const auto& [name, cost] : costs) sum += cost.instructions;
  return sum;
}

/// Returns "motion_simplified" for ".../lib/muro/motion_simplified.so", "core" for the program, "" for other objects.
std::string plugin_of(const std::string& object, const std::string& plugin_folder, const std::string& program) {
  if (object == program) return "core";
  if (!object.starts_with(plugin_folder + "/")) return "";
  const std::string name = object.substr(object.rfind('/') + 1);
  return name.substr(0, name.find('.'));
}

/// Returns a name of limited length: those of templates can have a thousand characters.
std::string shortened(const std::string& function) {
  constexpr std::size_t longest = 110;
  return function.size() <= longest ? function : function.substr(0, longest) + "...";
}

double ratio(std::uint64_t now, std::uint64_t before) {
  return double(now) / double(std::max<std::uint64_t>(before, 1));
}

/// Returns the functions that have grown most beyond the budget. Functions that are too small for a budget and have
/// none are left out.
std::string where(const Cost& budget, const Cost& now) {
  struct Growth {
    std::string name;
    std::uint64_t before, now;
    std::int64_t by() const { return std::int64_t(now) - std::int64_t(before); }
  };
  std::vector<Growth> all;
  for (const auto& [name, instructions] : now.functions) {
    const auto before = budget.functions.find(name);
    const bool is_known = before != budget.functions.end();
    if (is_known || double(instructions) >= least_part_of_plugin * double(now.instructions))
      all.push_back({name, is_known ? before->second : 0, instructions});
  }
  std::sort(all.begin(), all.end(), [](const Growth& a, const Growth& b) { return a.by() > b.by(); });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 3); ++i)
    if (all[i].by() > 0) text += fmt::format("\n    {} instead of {}: {}", all[i].now, all[i].before, all[i].name);
  return text;
}

}  // namespace

std::vector<SceneBudget> read_budgets(const std::string& file) {
  std::ifstream in = open(file);
  std::vector<SceneBudget> scenes;
  std::string plugin;
  for (std::string line; std::getline(in, line);) {
    if (trimmed(line).empty() || line[0] == '#') continue;
    if (line.find('|') != std::string::npos && line[0] != ' ') {
      scenes.push_back(scene_of(line));
      continue;
    }
    std::istringstream words(line);
    std::uint64_t instructions = 0;
    std::string name;
    if (scenes.empty() || !(words >> instructions) || !std::getline(words, name))
      throw std::runtime_error(file + ": `" + line + "` has no number of instructions and a name");
    if (line[0] != ' ')
      scenes.back().costs[plugin = trimmed(name)].instructions = instructions;
    else
      scenes.back().costs[plugin].functions[trimmed(name)] = instructions;
  }
  return scenes;
}

void write_budgets(const std::string& file, const std::vector<SceneBudget>& scenes) {
  std::string text;
  {
    std::ifstream in = open(file);
    for (std::string line; std::getline(in, line) && line.starts_with('#');) text += line + "\n";
  }
  for (const SceneBudget& s : scenes) {
    text += fmt::format("\n{} | {} | {:g} | {:g} | {}\n", s.name, s.scenario, s.warm_up, s.duration,
                        fmt::join(s.overrides, " "));
    while (text[text.size() - 2] == ' ' || text[text.size() - 2] == '|') text.erase(text.size() - 2, 1);
    for (const auto& [plugin, cost] : s.costs) {
      if (double(cost.instructions) < least_part_of_scene * double(total(s.costs))) continue;
      text += fmt::format("{} {}\n", cost.instructions, plugin);
      for (const auto& [function, instructions] : cost.functions)
        if (double(instructions) >= least_part_of_plugin * double(cost.instructions))
          text += fmt::format("  {} {}\n", instructions, function);
    }
  }
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

Costs read_callgrind(const std::string& file, const std::string& plugin_folder, const std::string& program) {
  std::ifstream in = open(file);
  Costs costs;
  std::string plugin, function;
  bool is_inclusive = false;  // the line after `calls=` counts the called function, which has lines of its own
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("ob=")) {
      plugin = plugin_of(line.substr(3), plugin_folder, program);
    } else if (line.starts_with("fn=")) {
      function = shortened(line.substr(3));
    } else if (line.starts_with("calls=")) {
      is_inclusive = true;
    } else if (!line.empty() && line[0] >= '0' && line[0] <= '9') {
      std::uint64_t position = 0, instructions = 0;
      std::istringstream(line) >> position >> instructions;
      if (!is_inclusive && !plugin.empty()) {
        Cost& cost = costs[plugin];
        cost.instructions += instructions;
        cost.functions[function] += instructions;
      }
      is_inclusive = false;
    }
  }
  return costs;
}

std::vector<std::string> grown(const SceneBudget& budget, const Costs& now, double allowance) {
  std::vector<std::string> problems;
  const double least = least_part_of_scene * double(total(now));
  for (const auto& [plugin, cost] : now) {
    const auto found = budget.costs.find(plugin);
    if (found == budget.costs.end()) {
      // a cost just below a hundredth may rise above it
      if (double(cost.instructions) > 1.5 * least)
        problems.push_back(fmt::format("{}: {} executes {} instructions and has no budget{}", budget.name, plugin,
                                       cost.instructions, where({}, cost)));
      continue;
    }
    const Cost& allowed = found->second;
    if (ratio(cost.instructions, allowed.instructions) > 1 + allowance)
      problems.push_back(fmt::format("{}: {} executes {} instructions, {:.1f} % more than its budget of {}{}",
                                     budget.name, plugin, cost.instructions,
                                     100 * (ratio(cost.instructions, allowed.instructions) - 1), allowed.instructions,
                                     where(allowed, cost)));
  }
  return problems;
}

}  // namespace muro::costs
