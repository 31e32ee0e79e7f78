// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/model_check/level_check.hpp"
#include "host/commands/open.hpp"
#include "host/names.hpp"
#include "host/scenario/features/unsupported_features.hpp"

namespace muro::host {

Scenario open_file(const ScenarioOptions& options, const Registry& registry,
                   const std::function<void(Node& root)>& complete) {
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  Scenario scenario = read_scenario(options.file, options.overrides, complete);
  if (options.seed) scenario.seed = *options.seed;
  return scenario;
}

BuiltScenario open_scenario(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more) {
  BuiltScenario built = build(std::move(scenario), registry, add_more);
  for (const std::string& n : built.notes) fmt::print(stderr, "{}\n", message_text(n));
  return built;
}

BuiltScenario look_at_scenario(const ScenarioOptions& options, Registry& registry) {
  return open_scenario(open_file(options, registry), registry, [](Simulation& s) { s.keep_outputs_closed(); });
}

namespace {

/// Messages of readers and algorithms while the scenario is built, in their order. Messages that the check itself
/// replaces are left out.
class Remarks {
 public:
  void add(const std::string& text) {
    if (text.find("`muro check`") != text.npos || text.find(": no link has a mass;") != text.npos) return;
    std::string kind = kind_of(text);
    const auto known = std::find_if(all_.begin(), all_.end(), [&](const Alike& a) { return a.kind == kind; });
    if (known == all_.end())
      all_.push_back({std::move(kind), {text}});
    else if (std::find(known->texts.begin(), known->texts.end(), text) == known->texts.end())
      known->texts.push_back(text);
  }

  void print(Length length) const {
    std::size_t lines = 0, left = 0;
    for (const Alike& a : all_) {
      const std::size_t shown = length == Length::full ? a.texts.size() : lines < most_lines ? 1 : 0;
      for (std::size_t i = 0; i < shown; ++i) {
        const std::string more = i + 1 == shown && shown < a.texts.size()
                                     ? fmt::format(" (and {} more like this)", a.texts.size() - shown)
                                     : "";
        fmt::print(stderr, "{}{}\n", message_text(a.texts[i]), more);
      }
      lines += shown;
      left += shown == 0 ? a.texts.size() : 0;
    }
    if (left > 0) fmt::print(stderr, "and {}; `muro check --full` prints all\n", plural(left, "other remark"));
  }

 private:
  static constexpr std::size_t most_lines = 10;
  /// Remarks that differ only in names and numbers.
  struct Alike {
    std::string kind;
    std::vector<std::string> texts;
  };

  /// Returns the text without the parts in backquotes, and without numbers.
  static std::string kind_of(const std::string& text) {
    std::string kind;
    bool quoted = false;
    for (const char c : text) {
      if (c == '`') quoted = !quoted;
      if (!quoted && !(c >= '0' && c <= '9')) kind += c;
    }
    return kind;
  }

  std::vector<Alike> all_;
};

}  // namespace

int check(const CheckOptions& options) {
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  const Length length = options.full ? Length::full : Length::screen;
  Remarks remarks;
  const BuiltScenario built = build(open_file(options.scenario, registry), registry, [&](Simulation& s) {
    s.keep_outputs_closed();
    s.set_log([&](LogLevel level, std::string_view text) {
      if (level == LogLevel::debug) return;
      const char* const severity = level == LogLevel::error ? "error" : level == LogLevel::warning ? "warning" : "note";
      remarks.add(fmt::format("{}: {}", severity, text));
    });
  });
  for (const std::string& note : built.notes) remarks.add(note);
  remarks.print(length);
  if (options.scenario.strict) report_unsupported(built, Detail::full, true);
  for (const std::string& line : check_lines(built, length)) fmt::print("{}\n", message_text(line));
  if (options.levels)
    for (const std::string& line : level_lines(options.scenario, built, registry, length))
      fmt::print("{}\n", message_text(line));
  const World& world = built.simulation->world();
  fmt::print("{}: {}, {}, {}: all is connected\n", options.scenario.file, plural(world.robots().size(), "robot"),
             plural(world.object_count(), "object"), plural(built.simulation->instances().size(), "algorithm"));
  return 0;
}

}  // namespace muro::host
