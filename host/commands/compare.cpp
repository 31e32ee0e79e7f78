// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <algorithm>

#include "core/output_registry.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/compare_against.hpp"
#include "host/commands/current_run.hpp"
#include "host/names.hpp"
#include "host/outputs/failures.hpp"
#include "host/outputs/messages.hpp"
#include "host/outputs/output_file.hpp"
#include "host/tools/compare/table.hpp"

namespace muro::host {

namespace {

void check_files(const CompareOptions& options) {
  const std::string& file = options.picture;
  const auto ends = [&](const char* end) { return file.size() > 4 && file.substr(file.size() - 4) == end; };
  if (!file.empty() && !ends(".svg"))
    throw SetupError(fmt::format(
        "--out {}: pictures are SVG files, so name it *.svg{}", file,
        ends(".png") ? fmt::format("; `rsvg-convert FILE.svg -o {}` (Debian: librsvg2-bin) makes it a PNG", file)
                     : ""));
}

/// Runs once before the runs; each variation adds the files that it reads.
void check_outputs(const Comparison& comparison, Registry& registry) {
  Simulation empty(registry);
  for (const std::string& file : comparison.scenario.files) empty.outputs().add_input(file, "a file of the scenario");
  add_outputs(empty, comparison.outputs);
  empty.outputs().check();
}

Comparison read_comparison(const CompareOptions& options, Registry& registry) {
  Comparison c;
  c.scenario.file = options.scenario.file;
  c.overrides = options.scenario.overrides;
  c.seed = options.scenario.seed;
  c.scenario = read_variation(c, {}, registry);
  registry.choose(c.scenario.plugins);
  for (const std::string& v : options.vary) c.factors.push_back(read_factor(v, c.scenario, registry));
  c.duration = options.duration.value_or(c.scenario.duration);
  if (c.duration <= 0) throw SetupError("there is nothing to compare in 0 s; give --duration a number of seconds");
  c.robots = robots_of(c.scenario, c.factors);
  if (c.robots.empty()) throw SetupError(options.scenario.file + ": there are no robots to compare");
  c.outputs = {{"--out", options.picture}, {"--csv", options.table}};
  check_outputs(c, registry);
  return c;
}

std::size_t find_reference(const std::string& name, const std::vector<Variation>& variations) {
  if (name.empty()) return variations.size() - 1;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < variations.size(); ++i) {
    const Variation& v = variations[i];
    if (v.label == name || (v.choices.size() == 1 && v.choices.front()->use == name)) return i;
    labels.push_back(v.label);
  }
  throw SetupError(fmt::format("--reference {}: nothing of this name is compared{}", name, suggestion(name, labels)));
}

}  // namespace

int compare(const CompareOptions& options) {
  check_files(options);
  if (options.against.empty() && options.vary.empty())
    throw SetupError(
        "--vary says what is compared, and is missing; or compare with records of a real joint or laser: --against");
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  const Comparison comparison = read_comparison(options, registry);
  const std::vector<Variation> variations = all_variations(comparison.factors);
  if (!options.against.empty()) return compare_against(options, comparison, variations, registry);
  const std::size_t reference = find_reference(options.reference, variations);

  const CurrentRun progress;
  Messages messages;
  std::vector<VariationResult> results;
  for (const Variation& v : variations) {
    progress.show(v.label);
    results.push_back(run_variation(comparison, v, registry, [&](LogLevel level, std::string_view text) {
      progress.close();
      messages.log(level, text);
      progress.show(v.label);
    }));
    progress.close();
    for (const std::string& n : results.back().notes) messages.say(n);
  }

  const Compared compared{comparison, results, reference};
  std::string unwritten;
  Failures failures(unwritten);
  if (!options.table.empty()) failures.guard([&] { write_file(options.table, csv(compared)); });
  if (!options.picture.empty()) failures.guard([&] { write_file(options.picture, picture(compared)); });
  fmt::print("{}", table(compared));
  if (!unwritten.empty()) throw StepError(unwritten);
  const auto succeeded =
      std::count_if(results.begin(), results.end(), [](const VariationResult& r) { return r.failure.empty(); });
  return results[reference].failure.empty() && (succeeded > 1 || results.size() == 1) ? 0 : 1;
}

}  // namespace muro::host
