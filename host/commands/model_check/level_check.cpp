// SPDX-License-Identifier: MIT
#include "host/commands/model_check/level_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/instance.hpp"
#include "host/names.hpp"
#include "host/scenario/features/unsupported_features.hpp"

namespace muro::host {

namespace {

/// The motion of a template: its name, and whether it fixes the base.
struct OwnMotion {
  std::string name;
  bool fixed_base = false;
};

std::optional<OwnMotion> motion_of(const RobotTemplate& t, const Registry& registry) {
  if (t.subsystems.size() == 0) return {};
  for (const Subsystem& s : t.subsystems[0]) {
    const auto& catalog = registry.catalog();
    const auto entry =
        std::find_if(catalog.begin(), catalog.end(), [&](const CatalogEntry& e) { return e.id == s.use; });
    if (entry == catalog.end() || entry->kind != "motion") continue;
    const auto base = s.parameters.find("base");
    const auto* text = base == s.parameters.end() ? nullptr : std::get_if<std::string>(&base->second);
    return OwnMotion{s.level ? s.name.substr(0, s.name.rfind('.')) : s.name, text && *text == "fixed"};
  }
  return {};
}

/// Returns the first mistake, without its place, not longer than a line.
std::string brief(std::string text) {
  text = text.substr(0, text.find('\n'));
  constexpr std::string_view place = "cannot be connected: ";
  if (const std::size_t at = text.find(place); at != text.npos) text.erase(0, at + place.size());
  constexpr std::size_t most = 110;
  return text.size() > most ? text.substr(0, text.rfind(' ', most)) + " ..." : text;
}

/// Describes what would happen with another motion.
std::string verdict(const ScenarioOptions& options, const std::string& robots, const OwnMotion& own,
                    const CatalogEntry& motion, Registry& registry) {
  try {
    std::vector<std::string> overrides = options.overrides;
    const Description& description = *registry.algorithm(motion.id).description;
    const bool fixes = own.fixed_base && std::any_of(description.parameters.begin(), description.parameters.end(),
                                                     [](const Parameter& p) { return p.name == "base"; });
    overrides.push_back(
        fmt::format("robots.{}.{}={{use: {}{}}}", robots, own.name, motion.id, fixes ? ", base: fixed" : ""));
    Scenario scenario = read_scenario(options.file, overrides);
    if (options.seed) scenario.seed = *options.seed;
    const BuiltScenario built = build(std::move(scenario), registry, [](Simulation& s) {
      s.keep_outputs_closed();
      s.set_log([](LogLevel, std::string_view) {});
    });
    for (const UnsupportedFeatures& u : find_unsupported_features(built))
      if (u.robots == robots && u.motion == motion.id) return "takes it; " + brief(text_of(u, Detail::brief));
    return "takes it as it is";
  } catch (const std::exception& e) {
    return "refuses it: " + brief(e.what());
  }
}

}  // namespace

std::vector<std::string> level_lines(const ScenarioOptions& options, const BuiltScenario& built, Registry& registry,
                                     Length length) {
  std::vector<std::string> lines;
  constexpr std::size_t most_templates = 3;
  std::vector<std::string> left;
  std::size_t shown = 0;
  for (const RobotTemplate& t : built.scenario.robots) {
    const std::optional<OwnMotion> own = motion_of(t, registry);
    if (!own) continue;
    if (length == Length::screen && shown == most_templates) {
      left.push_back(t.name);
      continue;
    }
    ++shown;
    lines.push_back(
        fmt::format("`{}` with each motion{}:", t.name, own->fixed_base ? ", its base fixed where it can be" : ""));
    for (const CatalogEntry& motion : registry.catalog())
      if (motion.kind == "motion")
        lines.push_back(fmt::format("  {:<26}{}", motion.id, verdict(options, t.name, *own, motion, registry)));
  }
  if (!left.empty())
    lines.push_back(fmt::format("and {} more: {}; `muro check --levels --full` tells of them",
                                plural(left.size(), "template"), first_of(left, 3)));
  return lines;
}

}  // namespace muro::host
