// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "host/commands/commands.hpp"
#include "host/compare/table.hpp"
#include "host/names.hpp"
#include "host/output_file.hpp"

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
  for (const std::string& f : {options.picture, options.table})
    if (!f.empty()) check_writable(f);  // now rather than after the runs
}

Comparison read_comparison(const CompareOptions& options, const Registry& registry) {
  Comparison c;
  c.scenario.file = options.scenario.file;
  c.overrides = options.scenario.overrides;
  c.seed = options.scenario.seed;
  c.scenario = read_variation(c, {}, registry);
  for (const std::string& v : options.vary) c.factors.push_back(read_factor(v, c.scenario, registry));
  c.duration = options.duration.value_or(c.scenario.duration);
  if (c.duration <= 0) throw SetupError("there is nothing to compare in 0 s; give --duration a number of seconds");
  c.robots = robots_of(c.scenario, c.factors);
  if (c.robots.empty()) throw SetupError(options.scenario.file + ": there are no robots to compare");
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

/// The variation that runs, on one line of the terminal.
class CurrentRun {
 public:
  void show(const std::string& label) const {
    if (shown_) fmt::print(stderr, "\r\033[K{} ...", label), std::fflush(stderr);
  }
  void close() const {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool shown_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace

int compare(const CompareOptions& options) {
  check_files(options);
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  const Comparison comparison = read_comparison(options, registry);
  const std::vector<Variation> variations = all_variations(comparison.factors);
  const std::size_t reference = find_reference(options.reference, variations);

  const CurrentRun progress;
  std::vector<VariationResult> results;
  bool noted = false;
  for (const Variation& v : variations) {
    progress.show(v.label);
    results.push_back(run_variation(comparison, v, registry));
    progress.close();
    if (!noted)
      for (const std::string& n : results.back().notes) fmt::print(stderr, "{}\n", n), noted = true;
  }

  const Compared compared{comparison, results, reference};
  fmt::print("{}", table(compared));
  if (!options.table.empty()) write_file(options.table, csv(compared));
  if (!options.picture.empty()) write_file(options.picture, picture(compared));
  const auto succeeded =
      std::count_if(results.begin(), results.end(), [](const VariationResult& r) { return r.failure.empty(); });
  return results[reference].failure.empty() && (succeeded > 1 || results.size() == 1) ? 0 : 1;
}

}  // namespace muro::host
