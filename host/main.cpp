// SPDX-License-Identifier: MIT
// The program `muro`. Exit codes: 0 done, 1 the simulation failed, 2 wrong input, 130 interrupted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <iostream>
#include <new>
#include <sstream>

#include "core/error.hpp"
#include "host/commands/commands.hpp"
#include "host/names.hpp"
#include "host/outputs/standard_output.hpp"
#include "host/process/crash_report.hpp"
#include "host/process/exit_guard.hpp"
#include "host/process/out_of_memory.hpp"
#include "host/process/standard_error.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/base/did_you_mean.hpp"

namespace {

using namespace muro::host;

/// Checks of the command line; CLI11 accepts `nan` and `-1` as numbers.
std::string check_duration(const std::string& text) {
  double x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool fine = code == std::errc{} && used == text.data() + text.size() && x >= 0 && x <= 1e9;
  return fine ? "" : "`" + text + "` is no number of seconds from 0 to 1e9";
}
std::string check_step_timeout(const std::string& text) {
  double x = 0;
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool fine = code == std::errc{} && used == text.data() + text.size() && x >= 0.01 && x <= 1e9;
  return fine ? "" : "`" + text + "` is no number of seconds from 0.01 to 1e9";
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

/// Returns the message for a missing or an unknown command; empty when there is none.
std::string unknown_command(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(c->get_name());
  const std::vector<std::string> words = app.remaining();
  const auto word =
      std::find_if(words.begin(), words.end(), [](const std::string& w) { return !w.empty() && w.front() != '-'; });
  const std::string allowed = comma_separated(names);
  if (app.get_subcommands().empty() && words.empty())
    return fmt::format("muro needs a command: {}; muro --help tells more", allowed);
  if (!app.get_subcommands().empty() || word == words.end()) return "";
  return fmt::format("muro has no command `{}`{}; commands: {}", *word, muro::did_you_mean(*word, names), allowed);
}

CLI::Option* repeatable(CLI::Option* option) { return option->take_all()->allow_extra_args(false); }

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("scenario", options.file, "Scenario file (YAML)")->required();
  repeatable(command.add_option("--set", options.overrides,
                                "Override a value: path=value, e.g. robots.rovers.count=100 (repeatable)"));
  command.add_option("--seed", options.seed, "Seed of all random numbers")->check(check_seed);
}

void add_strict_option(CLI::App& command, ScenarioOptions& options) {
  command.add_flag("--strict", options.strict,
                   "Unsupported features and missing collision shapes are errors, not notes");
}

/// Adds each command to the program and calls it when it is given; the exit code goes to `exit_code`.
struct Commands {
  CLI::App& app;
  std::vector<std::string> plugin_path{};
  RunOptions run_options{};
  CheckOptions check_options{};
  ScenarioOptions describe_options{};
  CompareOptions compare_options{};
  IdentifyOptions identify_options{};
  RenderOptions render_options{};
  AllanOptions allan_options{};
  bool json = false, markdown = false;
  std::string id{};
  int exit_code = 0;

  explicit Commands(CLI::App& a) : app(a) {
    repeatable(app.add_option("--plugin-path", plugin_path, "Folder with plugins, before all others (repeatable)"));
    add_run();
    add_check();
    add_compare();
    add_identify();
    add_render();
    add_sensors();
    add_describe();
    add_plugins();
    add_properties();
  }

  Format format() const { return json ? Format::json : (markdown ? Format::markdown : Format::plain); }

  void add_run() {
    CLI::App& command = *app.add_subcommand("run", "Run a scenario");
    add_scenario_options(command, run_options.scenario);
    command.add_option("--duration", run_options.duration, "Simulated seconds; default: as the scenario says")
        ->check(check_duration);
    command.add_flag("--include-end", run_options.include_end,
                     "Also run what is due at the end itself: recorders have a row for it");
    command.add_option("--speed", run_options.speed,
                       "max, real, or a factor of real time; default: max, with --view real");
    command.add_flag("--view", run_options.view, "Show the run in a window: view.window");
    command.add_option("--threads", run_options.threads, "Threads to use at most, or all; no result depends on it")
        ->check(check_threads);
    command.add_option("--report", run_options.report, "Write a report to this file (JSON)");
    command.add_option("--timeline", run_options.timeline,
                       "Write which algorithm ran when on which thread (JSON for Perfetto or chrome://tracing)");
    command.add_option("--record", run_options.record,
                       "Write all that comes from outside (clients, placing) to this file: recorder.inputs");
    command.add_option("--replay", run_options.replay,
                       "Run as recorded in this file, without clients: controller.replay");
    command
        .add_option("--step-timeout", run_options.step_timeout,
                    "Wall-clock seconds after which a step that does not return ends the run, and is named")
        ->check(check_step_timeout);
    command.add_flag("--verify-access", run_options.verify_access,
                     "Prove that algorithms access only the properties that they have declared (slow)");
    command.add_flag("--profile", run_options.profile, "Print what each algorithm costs");
    add_strict_option(command, run_options.scenario);
    command.callback([this] {
      run_options.scenario.plugin_path = plugin_path;
      exit_code = run(run_options);
    });
  }

  void add_check() {
    CLI::App& command = *app.add_subcommand(
        "check", "Read and connect a scenario without running it, and tell what its models lack for their motions");
    add_scenario_options(command, check_options.scenario);
    add_strict_option(command, check_options.scenario);
    command.add_flag("--levels", check_options.levels, "Tell how every motion would serve the robots");
    command.add_flag("--full", check_options.full, "Tell everything, also where that is more than a screen");
    command.callback([this] {
      check_options.scenario.plugin_path = plugin_path;
      exit_code = check(check_options);
    });
  }

  void add_compare() {
    CLI::App& command =
        *app.add_subcommand("compare", "Run a scenario with different algorithms: cost against deviation");
    add_scenario_options(command, compare_options.scenario);
    repeatable(command.add_option(
        "--vary", compare_options.vary,
        "What differs: ROBOTS.SUBSYSTEM=NAME,NAME,..., e.g. rovers.motion=point,simplified (repeatable)"));
    command.add_option("--reference", compare_options.reference,
                       "What the others are compared with; default: the last");
    command.add_option("--duration", compare_options.duration, "Simulated seconds; default: as the scenario says")
        ->check(check_duration);
    command.add_option("--against", compare_options.against,
                       "Recordings of a real joint (as for identify): run on their commands, and tell the deviation; "
                       "or of a laser scanner that stands still (SCIP 2.0, CSV): its noise, mixed pixels, drop-outs");
    command.add_option("--joint", compare_options.joint, "ROBOT/JOINT that was recorded; default: the only one");
    command.add_option("--sensor", compare_options.sensor,
                       "ROBOT/LASER to compare with recorded scans; default: the only one");
    command.add_flag("--known-map", compare_options.known_map,
                     "The scene is where the scans were recorded, the scanner at its place: tell the bias, too");
    command.add_option("--out", compare_options.picture,
                       "Draw cost against deviation (--against: errors over time, or noise over range) into this file "
                       "(SVG)");
    command.add_option("--csv", compare_options.table, "Write the table to this file (CSV)");
    command.callback([this] {
      compare_options.scenario.plugin_path = plugin_path;
      exit_code = compare(compare_options);
    });
  }

  void add_identify() {
    CLI::App& command = *app.add_subcommand(
        "identify", "Find the parameters of a servo's motor from recorded trajectories: see docs/guide/motors.md");
    IdentifyOptions& o = identify_options;
    command.add_option("records", o.records, "Recordings: CSV with a header, or JSON of Rhoban/bam")->required();
    command.add_option("--model", o.model, "Friction: m1 Coulomb and viscous, m2 Stribeck, m3 by load, m4 both")
        ->capture_default_str();
    repeatable(
        command.add_option("--fit", o.fit, "Find this, too: gain (of the firmware), delay, temperature (repeatable)"));
    command.add_option(
        "--validate", o.validate,
        "Records that are left out of the fit, or a part of all such as 0.25, chosen by the seed; default: "
        "each record in turn, by more fits");
    command.add_flag("--cross-validate", o.cross_validate, "Fit again without the records of each P gain in turn");
    command
        .add_option("--duty-gain", o.duty_gain, "Of the firmware: duty by error, 1/rad, for each unit of the P gain")
        ->check(CLI::Range(1e-12, 1e12));
    command.add_option("--duty-limit", o.duty_limit, "Of the firmware: the largest duty")->check(CLI::Range(1e-3, 1.0));
    command.add_option("--p-gain", o.p_gain, "Of all records, in units of the firmware")->check(CLI::Range(1e-9, 1e12));
    command.add_option("--supply", o.supply_voltage, "Of all records, V")->check(CLI::Range(1e-3, 1e4));
    command.add_option("--mass", o.mass, "Of the load, kg")->check(CLI::Range(0.0, 1e6));
    command.add_option("--length", o.length, "From the axis to the mass, m")->check(CLI::Range(0.0, 1e3));
    command.add_option("--arm-mass", o.arm_mass, "Of the rod between them, kg")->check(CLI::Range(0.0, 1e6));
    command.add_option("--inertia", o.inertia, "Of the load, beside these, kg m^2")->check(CLI::Range(0.0, 1e9));
    command.add_option("--seed", o.seed, "Of the search")->check(check_seed);
    command.add_option("--threads", o.threads, "Threads to use at most; no result depends on it; default: all")
        ->check(CLI::Range(1u, 1024u));
    repeatable(command.add_option("--report", o.reports, "Write the report to this file, *.md or *.json (repeatable)"));
    command.add_option("--plot", o.plot, "Draw the errors over time into this file (SVG)");
    command.add_option("--fragment", o.fragment, "Write the motor, as a scenario has it, to this file (YAML)");
    command.callback([this] { exit_code = identify(identify_options); });
  }

  void add_render() {
    CLI::App& command = *app.add_subcommand("render", "Draw a picture of a scenario at one time, or a video");
    add_scenario_options(command, render_options.scenario);
    command.add_option("--at", render_options.at, "Simulated seconds after which it is drawn")
        ->check(check_duration)
        ->capture_default_str();
    command.add_option("--out", render_options.out, "File of the picture (PNG)");
    command.add_option("--video", render_options.video, "File of a video from --at on, by ffmpeg: NAME.mp4");
    command.add_option("--until", render_options.until, "Simulated seconds at its end; default: as the scenario says")
        ->check(check_duration);
    command.add_option("--fps", render_options.fps, "Frames of the video in a simulated second")
        ->check(CLI::Range(0.01, 1000.0))
        ->capture_default_str();
    command.add_option("--camera", render_options.camera, "The camera of a robot, e.g. rover/camera");
    command
        .add_option("--from", render_options.from,
                    "Position of a free camera, x,y,z in metres; default: so that the robots that move are seen")
        ->delimiter(',')
        ->expected(3);
    command
        .add_option("--to", render_options.to,
                    "The point that it looks at, x,y,z in metres; default: the middle of the robots that move, which "
                    "it follows")
        ->delimiter(',')
        ->expected(3);
    command
        .add_option("--shows", render_options.shows, "Output of a robot's camera: rgb, depth (dark is near) or labels")
        ->check(CLI::IsMember({"rgb", "depth", "labels"}))
        ->capture_default_str();
    command.add_option("--fov", render_options.fov, "Horizontal opening angle in degrees")
        ->check(CLI::Range(1.0, 170.0))
        ->capture_default_str();
    command.add_option("--size", render_options.size, "Pixels")->capture_default_str();
    command.add_option("--device", render_options.device, "Renderer: auto, gpu or software")
        ->check(CLI::IsMember({"auto", "gpu", "software"}))
        ->capture_default_str();
    command.callback([this] {
      render_options.scenario.plugin_path = plugin_path;
      exit_code = render(render_options);
    });
  }

  void add_sensors() {
    CLI::App& command = *app.add_subcommand("sensors", "Look at the errors of sensors");
    command.require_subcommand(1);
    CLI::App& allan_command = *command.add_subcommand(
        "allan", "Run a scenario, and compare the Allan deviation of a sensor with the data sheet of its sensor.error");
    add_scenario_options(allan_command, allan_options.scenario);
    allan_command.add_option("--sensor", allan_options.sensor, "The sensor of a robot, e.g. rover/imu")->required();
    allan_command.add_option("--reading", allan_options.reading,
                             "What it reads, e.g. angular_velocity; default: all that a sensor.error works on");
    allan_command.add_option("--duration", allan_options.duration, "Simulated seconds; default: as the scenario says")
        ->check(check_duration);
    allan_command.add_option("--out", allan_options.picture, "Draw the curve of one reading into this file (SVG)");
    allan_command.callback([this] {
      allan_options.scenario.plugin_path = plugin_path;
      exit_code = allan(allan_options);
    });
  }

  void add_describe() {
    CLI::App& command =
        *app.add_subcommand("describe", "Show objects, properties, who writes and reads them, and the schedule");
    add_scenario_options(command, describe_options);
    command.add_flag("--json", json, "As JSON");
    command.callback([this] {
      describe_options.plugin_path = plugin_path;
      exit_code = describe(describe_options, json);
    });
  }

  void add_format_options(CLI::App& command) {
    CLI::Option* as_json = command.add_flag("--json", json, "As JSON");
    command.add_flag("--markdown", markdown, "As a page in Markdown")->excludes(as_json);
  }

  void add_plugins() {
    CLI::App& command = *app.add_subcommand("plugins", "Show what plugins offer");
    command.require_subcommand(1);
    CLI::App& list = *command.add_subcommand("list", "All algorithms and model readers");
    add_format_options(list);
    list.callback([this] { exit_code = list_plugins(plugin_path, format()); });
    CLI::App& info = *command.add_subcommand("info", "One of them: parameters, properties, capabilities");
    info.add_option("name", id, "Such as motion.point")->required();
    info.add_flag("--json", json, "As JSON");
    info.callback([this] { exit_code = plugin_info(id, plugin_path, json); });
  }

  void add_properties() {
    CLI::App& command =
        *app.add_subcommand("properties", "Show the standard properties: types, units, who writes and reads them");
    add_format_options(command);
    command.callback([this] { exit_code = list_properties(plugin_path, format()); });
  }
};

int dispatch(int argc, char** argv) {
  CLI::App app{"muro: a simulator for teams of robots, each at its own level of detail"};
  app.require_subcommand(1);
  app.fallthrough();
  Commands commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (const std::string text = unknown_command(app); e.get_exit_code() != 0 && !text.empty())
      throw muro::SetupError(text);
    std::ostringstream complaint;
    const int code = app.exit(e, std::cout, complaint);
    fmt::print(stderr, "{}", muro::message_text(complaint.str()));
    return code == 0 ? 0 : 2;
  }
  return commands.exit_code;
}

int exit_code_of(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const muro::SetupError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const muro::StepError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}\n", muro::host::lack_of_memory);
    return 2;
  } catch (const std::exception& e) {
    if (!standard_output_failed()) fmt::print(stderr, "muro failed: {}\n", muro::message_text(e.what()));
    return standard_output_failed() ? 0 : 1;  // close_standard_output reports it
  }
}

}  // namespace

int main(int argc, char** argv) {
  report_crashes();
  report_lack_of_memory();
  const ExitGuard guard;
  // a reader that leaves and a file that grows too large are errors of the writer, so that other outputs are closed
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // if the parent process ignores it, the ends of processes are not reported
  keep_standard_streams();
  lose_what_standard_error_refuses();
  return close_standard_output(exit_code_of(argc, argv));
}
