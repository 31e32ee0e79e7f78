// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/external/input_log.hpp"
#include "core/external/reported_numbers.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/outputs/failures.hpp"
#include "host/outputs/json_text.hpp"
#include "host/outputs/output_file.hpp"
#include "host/outputs/output_options.hpp"
#include "host/outputs/report.hpp"
#include "host/outputs/slow_run.hpp"
#include "host/outputs/standard_output.hpp"
#include "host/outputs/timeline.hpp"
#include "host/process/interrupt.hpp"
#include "host/process/step_watch.hpp"
#include "host/scenario/features/unsupported_features.hpp"
#include "host/scenario/shadows.hpp"

namespace muro::host {

namespace {

double pacing_factor(const std::string& speed) {
  if (speed == "max" || speed.empty()) return 0;
  if (speed == "real") return 1;
  double factor = 0;
  const char* end = speed.data() + speed.size();
  const auto [used, code] = std::from_chars(speed.data(), end, factor);
  if (code == std::errc{} && used == end && factor >= 1e-6 && factor <= 1e6) return factor;
  throw SetupError(
      fmt::format("--speed is `{}` but must be max, real or a factor from 1e-6 to 1e6, such as 0.5", speed));
}

/// Shows progress on one line of the terminal, at most five times a second.
class Progress {
 public:
  explicit Progress(double duration) : duration_(duration), shown_(isatty(STDERR_FILENO) != 0) {}
  void show(double simulated, double wall) {
    if (!shown_ || wall - last_ < 0.2) return;
    last_ = wall;
    fmt::print(stderr, "\r\033[K{:.1f} of {:g} s simulated, {:.2f} times real time{}", simulated, duration_,
               wall > 0 ? simulated / wall : 0, time_left(simulated, wall));
    std::fflush(stderr);
  }
  void close() const {
    if (shown_ && last_ > 0) fmt::print(stderr, "\r\033[K");
  }

 private:
  /// Estimates the remaining time from the mean speed so far, as soon as that is meaningful.
  std::string time_left(double simulated, double wall) const {
    if (wall < 1 || simulated <= 0 || !(duration_ > simulated)) return "";
    const double left = wall * (duration_ - simulated) / simulated;
    if (left < 60) return fmt::format(", {:.0f} s left", left);
    const auto minutes = std::int64_t(std::min(left, 1e12) / 60);
    if (minutes < 60) return fmt::format(", {} min {} s left", minutes, std::int64_t(left) % 60);
    return fmt::format(", {} h {} min left", minutes / 60, minutes % 60);
  }

  double duration_;
  bool shown_;
  double last_ = 0;
};

/// Prints the properties that recorder.report has given: "referee/chair:score: [0] 2, [1] 1".
void print_properties(const ReportedNumbers& told) {
  for (const auto& [section, all] : told.sections()) {
    if (section != "properties") continue;
    for (const auto& [name, numbers] : all) {
      std::vector<std::string> parts;
      for (const auto& [element, value] : numbers)
        parts.push_back(element == "value" ? fmt::format("{}", value) : fmt::format("{} {}", element, value));
      fmt::print("{}: {}\n", message_text(name), fmt::join(parts, ", "));
    }
  }
}

void print_summary(const RunResult& result, const Simulation& simulation, const Odometer& odometer) {
  std::vector<const RobotView*> robots;
  for (const RobotView* r : simulation.world().robots())
    if (!is_shadow(simulation, *r)) robots.push_back(r);
  double min = 1e300, max = 0, sum = 0;
  for (const RobotView* r : robots) {
    const double d = odometer.distance(index_of(r->id));
    min = std::min(min, d);
    max = std::max(max, d);
    sum += d;
  }
  fmt::print("{}: {:g} s simulated in {:.2f} s ({:.2f} times real time){}\n", message_text(result.scenario),
             result.simulated, result.wall, result.wall > 0 ? result.simulated / result.wall : 0,
             result.interrupted ? ", interrupted" : "");
  if (!robots.empty())
    fmt::print("{} robots travelled {:.2f} m on average (minimum {:.2f}, maximum {:.2f})\n", robots.size(),
               sum / double(robots.size()), min, max);
  for (const ShadowResult& s : shadow_results(simulation))
    fmt::print(
        "{}: its shadow, moved by {}, deviates by {:.4f} m and {:.4f} rad at the end; by at most {:.4f} m and "
        "{:.4f} rad\n",
        s.robot, s.motion, s.distance, s.angle, s.max_distance, s.max_angle);
  print_properties(simulation.reported_numbers());
  fmt::print("state hash {:016x}\n", simulation.state_hash());
  if (const auto ids = nondeterministic_algorithms(simulation); !ids.empty())
    fmt::print("not deterministic: {}; another run may end in another state\n", fmt::join(ids, ", "));
  for (const std::string& why : simulation.inputs().reasons()) fmt::print("not repeatable: {}\n", why);
  const Lateness& late = simulation.scheduler().pacer().lateness();
  if (late.instants > 0)
    fmt::print(
        "paced: instants began {:.0f} us late on average, 99 % of them by less than {:.0f} us, the latest by {:.0f} "
        "us\n",
        1e6 * late.mean(), 1e6 * late.quantile(0.99), 1e6 * late.longest);
  if (late.overruns > 0) fmt::print("{} instants were late for the chosen speed\n", late.overruns);
}

/// Adds the recorder and the replay of inputs that the options request.
void add_inputs(Scenario& scenario, const RunOptions& options) {
  const auto add = [&](const char* name, const char* use, const std::string& file) {
    if (file.empty()) return;
    std::error_code code;
    const std::string path = std::filesystem::absolute(file, code).string();
    Subsystem s;
    s.name = fmt::format("{}_option", name);  // differs from all names in the scenario
    s.use = use;
    s.rate = 10;
    s.location.file = fmt::format("--{} {}", name, message_text(file));
    s.parameters.emplace("file", code ? file : path);
    scenario.algorithms.push_back(std::move(s));
  };
  add("record", "recorder.inputs", options.record);
  add("replay", "controller.replay", options.replay);
}

void require_view(const Registry& registry) {
  const auto& catalog = registry.catalog();
  if (std::none_of(catalog.begin(), catalog.end(), [](const CatalogEntry& e) { return e.id == "view.window"; }))
    throw SetupError(
        "--view needs the plugin view.window, which is not installed; install libglfw3-dev, libimgui-dev, "
        "libepoxy-dev, "
        "libegl-dev and libstb-dev, and build muro again");
}

/// Adds a window, which sets the pace, to the tree of a scenario, unless the file or an override has a window.
/// Overrides of `algorithms.view` apply to it.
void add_view(Node& root, const std::vector<std::string>& overrides, double speed) {
  const auto adds_window = [](const std::string& o) {
    return o.starts_with("algorithms.") && !o.starts_with("algorithms.view.") && o.ends_with(".use=view.window");
  };
  if (std::any_of(overrides.begin(), overrides.end(), adds_window)) return;
  if (const Node* const algorithms = root.find("algorithms"))
    for (const auto& [name, algorithm] : algorithms->map)
      if (const Node* const use = algorithm.find("use"); use && use->scalar == "view.window") return;
  for (const std::string& assignment :
       {std::string("algorithms.view.use=view.window"), std::string("algorithms.view.rate=60"),
        fmt::format("algorithms.view.speed={}", speed)})
    apply_override(root, assignment);
}

/// Runs to `end` (ns), to an interrupt or to a failure; if `includes_end`, also what is due at `end`. The error goes to
/// `result`, because recorders complete their files and the report is written after any end of a run.
void simulate(Simulation& simulation, std::int64_t end, bool includes_end, Odometer& odometer, RunResult& result) {
  Progress progress(1e-9 * double(end));
  SlowRun slow(simulation);
  const auto start = std::chrono::steady_clock::now();
  const auto wall = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const auto say = [&](const std::string& note) {
    if (note.empty()) return;
    progress.close();
    fmt::print(stderr, "{}\n", note);
  };
  const auto sample = [&] {
    odometer.check();
    odometer.sample();
    say(slow.note(wall()));
    progress.show(1e-9 * double(simulation.now()), wall());
  };
  Failures failures(result.error);
  failures.guard([&] {
    simulation.set_sampling(Odometer::period, sample);
    simulation.run_until(includes_end ? end + 1 : end, Interrupt::pending);
    sample();
  });
  simulation.set_sampling(0, {});
  result.wall = wall();
  result.simulated = 1e-9 * double(std::min(simulation.now(), end));
  result.interrupted = Interrupt::pending();
  progress.close();
  failures.guard([&] { simulation.finish(); });
}

/// Writes files first: standard output may be closed.
void write_outputs(const RunOptions& options, RunResult& result, const Simulation& simulation,
                   const Odometer& odometer) {
  Failures failures(result.error);
  if (!options.report.empty())
    failures.guard([&] { write_file(options.report, json_text(report(result, simulation, odometer)) + "\n"); });
  if (!options.timeline.empty()) failures.guard([&] { write_timeline(options.timeline, simulation); });
  if (simulation.scheduler().executor().timeline().full())
    fmt::print(stderr, "note: {} holds the first {} calls of a thread; use --duration to record a shorter run\n",
               options.timeline, timeline_calls);
  print_summary(result, simulation, odometer);
  if (options.profile) fmt::print("\n{}", profile(result, simulation));
}

}  // namespace

int run(const RunOptions& options) {
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  const double factor = options.view ? 0 : pacing_factor(options.speed);
  if (options.view) require_view(registry);
  const double view_speed = options.speed.empty() ? 1 : pacing_factor(options.speed);
  Scenario scenario = open_file(options.scenario, registry, [&](Node& root) {
    if (options.view) add_view(root, options.scenario.overrides, view_speed);
  });
  add_inputs(scenario, options);
  BuiltScenario built = open_scenario(std::move(scenario), registry, [&](Simulation& s) {
    add_outputs(s, {{"--report", options.report}, {"--timeline", options.timeline}});
  });
  report_unsupported(built, Detail::brief, options.scenario.strict);
  Simulation& simulation = *built.simulation;
  if (!options.threads.empty())
    simulation.set_threads(options.threads == "all" ? all_threads() : unsigned(std::stoul(options.threads)));
  if (!options.timeline.empty()) simulation.scheduler().executor().timeline().start(timeline_calls);
  if (options.verify_access) simulation.verify_access();
  simulation.set_pacing({factor});
  const Interrupt interrupt;
  const StepWatch watch(options.step_timeout);

  Odometer odometer(simulation);
  RunResult result{built.scenario.name, built.scenario.seed, 0, 0, false, ""};
  const double duration = options.duration.value_or(built.scenario.duration);
  simulate(simulation, std::llround(duration * 1e9), options.include_end, odometer, result);
  try {
    write_outputs(options, result, simulation, odometer);
  } catch (const std::system_error&) {
    if (!standard_output_failed()) throw;  // main() reports it
  }
  if (!result.error.empty()) {
    fmt::print(stderr, "{}\n", result.error);
    return 1;
  }
  return result.interrupted ? 130 : 0;
}

}  // namespace muro::host
