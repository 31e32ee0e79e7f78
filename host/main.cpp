// SPDX-License-Identifier: MIT
// The program `muro`. Exit codes: 0 done, 1 the simulation failed, 2 wrong input, 130 interrupted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "host/commands/commands.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace {

using namespace muro::host;

/// Checks of the command line; CLI11 lets `nan` and `-1` pass where a number is wanted.
std::string check_duration(const std::string& text) {
  double x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool fine = code == std::errc{} && used == text.data() + text.size() && x >= 0 && x <= 1e9;
  return fine ? "" : "`" + text + "` is no number of seconds from 0 to 1e9";
}
std::string check_seed(const std::string& text) {
  std::uint64_t x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool fine = code == std::errc{} && used == text.data() + text.size() && x <= std::uint64_t(1) << 53;
  return fine ? "" : "`" + text + "` is no whole number from 0 to 9007199254740992";
}

std::string check_threads(const std::string& text) {
  unsigned x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool fine = code == std::errc{} && used == text.data() + text.size() && x >= 1 && x <= max_threads;
  return fine || text == "all" ? "" : "`" + text + "` is neither `all` nor a number of threads from 1 to 1024";
}

/// What to say when there is no command, or a word that is none; else nothing.
std::string unknown_command(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(c->get_name());
  const std::vector<std::string> words = app.remaining();
  const auto word =
      std::find_if(words.begin(), words.end(), [](const std::string& w) { return !w.empty() && w.front() != '-'; });
  std::string allowed;
  for (const std::string& n : names) allowed += (allowed.empty() ? "" : ", ") + n;
  if (app.get_subcommands().empty() && words.empty())
    return "muro needs a command: " + allowed + "; muro --help tells more";
  if (!app.get_subcommands().empty() || word == words.end()) return "";
  return "muro has no command `" + *word + "`" + muro::did_you_mean(*word, names) + "; commands: " + allowed;
}

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("scenario", options.file, "Scenario file (YAML)")->required();
  command
      .add_option("--set", options.overrides, "Override a value: path=value, e.g. robots.rovers.count=100 (repeatable)")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--seed", options.seed, "Seed of all random numbers")->check(check_seed);
}

int dispatch(int argc, char** argv) {
  CLI::App app{"muro: a simulator for teams of robots, each at its own level of detail"};
  app.require_subcommand(1);
  std::vector<std::string> plugin_path;
  app.add_option("--plugin-path", plugin_path, "Folder with plugins, before all others (repeatable)")
      ->take_all()
      ->allow_extra_args(false);
  app.fallthrough();

  RunOptions run_options;
  CLI::App& run_command = *app.add_subcommand("run", "Run a scenario");
  add_scenario_options(run_command, run_options.scenario);
  run_command.add_option("--duration", run_options.duration, "Simulated seconds; default: as the scenario says")
      ->check(check_duration);
  run_command.add_option("--speed", run_options.speed,
                         "max, real, or a factor of real time; default: max, with --view real");
  run_command.add_flag("--view", run_options.view, "Show the run in a window: view.window");
  run_command.add_option("--threads", run_options.threads, "Threads to use at most, or all; no result depends on it")
      ->check(check_threads);
  run_command.add_option("--report", run_options.report, "Write a report to this file (JSON)");
  run_command.add_option("--timeline", run_options.timeline,
                         "Write which algorithm ran when on which thread (JSON for Perfetto or chrome://tracing)");
  run_command.add_flag("--verify-access", run_options.verify_access,
                       "Prove that algorithms touch only the properties that they have declared (slow)");
  run_command.add_flag("--profile", run_options.profile, "Print what each algorithm costs");

  const auto add_strict = [](CLI::App& command, ScenarioOptions& options) {
    command.add_flag("--strict", options.strict, "What a motion cannot do for its robot is an error, not a note");
  };
  add_strict(run_command, run_options.scenario);

  ScenarioOptions check_options;
  CLI::App& check_command = *app.add_subcommand("check", "Read and connect a scenario without running it");
  add_scenario_options(check_command, check_options);
  add_strict(check_command, check_options);

  CompareOptions compare_options;
  CLI::App& compare_command =
      *app.add_subcommand("compare", "Run a scenario with different algorithms: cost against deviation");
  add_scenario_options(compare_command, compare_options.scenario);
  compare_command
      .add_option("--vary", compare_options.vary,
                  "What differs: ROBOTS.SUBSYSTEM=NAME,NAME,..., e.g. rovers.motion=point,simplified (repeatable)")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  compare_command.add_option("--reference", compare_options.reference,
                             "What the others are compared with; default: the last");
  compare_command
      .add_option("--duration", compare_options.duration, "Simulated seconds; default: as the scenario says")
      ->check(check_duration);
  compare_command.add_option("--out", compare_options.picture, "Draw cost against deviation into this file (SVG)");
  compare_command.add_option("--csv", compare_options.table, "Write the table to this file (CSV)");

  RenderOptions render_options;
  CLI::App& render_command = *app.add_subcommand("render", "Draw a picture of a scenario at one time, or a film");
  add_scenario_options(render_command, render_options.scenario);
  render_command.add_option("--at", render_options.at, "Simulated seconds after which it is drawn")
      ->check(check_duration)
      ->capture_default_str();
  render_command.add_option("--out", render_options.out, "File of the picture (PNG)");
  render_command.add_option("--video", render_options.video, "File of a film from --at on, by ffmpeg: NAME.mp4");
  render_command
      .add_option("--until", render_options.until, "Simulated seconds at its end; default: as the scenario says")
      ->check(check_duration);
  render_command.add_option("--fps", render_options.fps, "Frames of the film in a simulated second")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  render_command.add_option("--camera", render_options.camera, "What a robot's camera sees, e.g. rover/camera");
  render_command
      .add_option("--from", render_options.from, "Where from, x,y,z in metres; default: so that all robots are seen")
      ->delimiter(',')
      ->expected(3);
  render_command.add_option("--to", render_options.to, "Where to, x,y,z in metres; default: the middle of the robots")
      ->delimiter(',')
      ->expected(3);
  render_command
      .add_option("--shows", render_options.shows, "Of a robot's camera: rgb, depth (dark is near) or labels")
      ->check(CLI::IsMember({"rgb", "depth", "labels"}))
      ->capture_default_str();
  render_command.add_option("--fov", render_options.fov, "Horizontal opening angle in degrees")
      ->check(CLI::Range(1.0, 170.0))
      ->capture_default_str();
  render_command.add_option("--size", render_options.size, "Pixels")->capture_default_str();
  render_command.add_option("--device", render_options.device, "What draws: auto, gpu or software")
      ->check(CLI::IsMember({"auto", "gpu", "software"}))
      ->capture_default_str();

  ScenarioOptions describe_options;
  bool json = false;
  CLI::App& describe_command =
      *app.add_subcommand("describe", "Show objects, properties, who writes and reads them, and the schedule");
  add_scenario_options(describe_command, describe_options);
  describe_command.add_flag("--json", json, "As JSON");

  CLI::App& plugins_command = *app.add_subcommand("plugins", "Show what plugins offer");
  plugins_command.require_subcommand(1);
  CLI::App& list_command = *plugins_command.add_subcommand("list", "All algorithms and model readers");
  bool markdown = false;
  CLI::Option* as_json = list_command.add_flag("--json", json, "As JSON");
  list_command.add_flag("--markdown", markdown, "As a table in Markdown")->excludes(as_json);
  std::string id;
  CLI::App& info_command = *plugins_command.add_subcommand("info", "One of them: parameters, properties, promises");
  info_command.add_option("name", id, "Such as motion.point")->required();
  info_command.add_flag("--json", json, "As JSON");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (const std::string text = unknown_command(app); e.get_exit_code() != 0 && !text.empty())
      throw muro::SetupError(text);
    return app.exit(e) == 0 ? 0 : 2;
  }
  run_options.scenario.plugin_path = check_options.plugin_path = describe_options.plugin_path =
      compare_options.scenario.plugin_path = render_options.scenario.plugin_path = plugin_path;
  if (run_command.parsed()) return run(run_options);
  if (render_command.parsed()) return render(render_options);
  if (check_command.parsed()) return check(check_options);
  if (compare_command.parsed()) return compare(compare_options);
  if (describe_command.parsed()) return describe(describe_options, json);
  if (info_command.parsed()) return plugin_info(id, plugin_path, json);
  return list_plugins(plugin_path, json ? ListForm::json : (markdown ? ListForm::markdown : ListForm::plain));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const muro::SetupError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const muro::StepError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "muro failed: {}\n", e.what());
    return 1;
  }
}
