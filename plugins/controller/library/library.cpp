// SPDX-License-Identifier: MIT
// Control code from a shared library with the C interface of sdk/c/muro_controller.h; see README.md.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "connections.hpp"
#include "control_library.hpp"
#include "controlled_robot.hpp"
#include "muro/ext/loaded_libraries.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"

namespace {

using namespace muro;
using namespace muro::control;

constexpr std::string_view isolations[] = {"none", "process"};
constexpr std::string_view failures[] = {"stop", "hold", "restart"};
constexpr double default_timeout = 5;          // s
constexpr std::int64_t default_memory = 1024;  // MiB
constexpr Parameter parameters[] = {
    text("library", "", "path of the library, or its name: `wander` for wander.so or libwander.so").required(),
    texts("inputs",
          "what inputs read: \"port=property\", \"port=object:property\"; several properties by commas, and a "
          "`*` in the object for all of such names"),
    texts("outputs", "what outputs write, in the same form"),
    texts("arguments", "\"name=value\", handed to the library"),
    texts("tunables", "\"name=number\", for numbers that the library lists"),
    texts("rates", "\"task=Hz\", for tasks that the library lists"),
    text("isolate", "none", "process: the control code of each robot runs in a process of its own").one_of(isolations),
    real("timeout", "s", default_timeout,
         "with `isolate: process`, how long a call may take, by the clock of the machine")
        .between(1e-3, 1e6),
    integer("memory", default_memory, "with `isolate: process`, MiB that the control code of a robot may take")
        .between(1, 1 << 24),
    text("on_failure", "stop",
         "what becomes of the run: it ends, the robot is left at rest, or its control code begins "
         "anew")
        .one_of(failures),
    integer("restarts", 3, "with `on_failure: restart`, how often a robot's control code may begin anew")
        .between(1, 1e6),
};
constexpr PropertyUse reads[] = {{"*", "what the library's inputs are named or connected to"}};
constexpr PropertyUse writes[] = {{"*", "what the library's outputs are named or connected to"},
                                  {"state.controller.*", "the library's state"}};
constexpr Description description{
    .id = "controller.library",
    .kind = Kind::controller,
    .version = "2.0.0",
    .summary = "Runs control code from a shared library (C interface, sdk/c/muro_controller.h)",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class LibraryController final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    read_settings(c);
    std::unique_ptr<ControlProcess> process = load(p.text("isolate") == "process");
    settings_.tunables = read_tunables(p.texts("tunables"), settings_.table);
    settings_.task_rates = read_rates(p.texts("rates"), settings_.table);
    if (LoadedLibraries* told = LoadedLibraries::of(c.host()))
      told->add({settings_.path, settings_.table.name, settings_.table.version});
    tell(c.host());
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const Item& item = c.items()[i];
      const std::string name = item.robot ? std::string(item.robot->name) : "world";
      const std::string state = block_name(c, item.object);
      auto* block =
          static_cast<StateBlock*>(c.state_block(item.object, state, StateBlock::size_for(settings_.table.state_size)));
      robots_.push_back(std::make_unique<ControlledRobot>(settings_, name, i, std::uint32_t(c.items().size()),
                                                          c.random_key(i), block));
      if (ExternalInputs* const inputs = settings_.functions ? nullptr : ExternalInputs::of(c.host()))
        robots_.back()->use_failure_log(std::make_unique<FailureLog>(*inputs, name + "/" + state));
      robots_.back()->create_own_properties(c, item.object);
      if (process) robots_.back()->use_process(std::move(process));
    }
  }

  void connect_by_name(Connector& c) override {
    const Parameters& p = c.parameters();
    const ControlTable& table = settings_.table;
    const Connections in = read_connections("inputs", p.texts("inputs"), table.inputs, table.name);
    const Connections out = read_connections("outputs", p.texts("outputs"), table.outputs, table.name);
    const RobotObjects objects(c);
    std::map<std::string, std::string> missing;  // optional inputs that robots lack, each with the first such robot
    for (const auto& robot : robots_)
      for (const std::string& port : robot->connect(c, objects, in, out)) missing.emplace(port, robot->name());
    for (const auto& [port, robot] : missing)
      c.host().log(LogLevel::warning, "robot `" + robot + "`: `" + table.name + "` runs without its input `" + port +
                                          "`, which nothing of the robot provides");
    tell_first(c.host(), LogLevel::warning, &ControlledRobot::doubts);
    tell_first(c.host(), LogLevel::info, &ControlledRobot::notes);
  }

  void start() override {
    for (const auto& robot : robots_) robot->start();
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) robots_[i]->step(step);
  }

  void finish() override {
    ReportEntries* const report = ReportEntries::of(*settings_.host);
    for (std::size_t i = 0; report && i < robots_.size(); ++i) robots_[i]->report(*report);
  }

  void restored() override {
    for (const auto& robot : robots_) robot->restored();
  }

 private:
  void read_settings(Connector& c) {
    const Parameters& p = c.parameters();
    for (const std::string_view text : p.texts("arguments")) {
      const std::size_t equals = text.find('=');
      if (equals == std::string_view::npos || equals == 0)
        throw Error("`arguments`: `" + std::string(text) + "` must be \"name=value\"");
      settings_.arguments.emplace_back(text);
    }
    const std::string_view name = p.text("library");
    const std::filesystem::path as_path(c.resolve_path(name)), beside_scenario(c.resolve_path("name"));
    settings_.path = find_library(name, as_path.string(), search_folders(beside_scenario.parent_path().string()));
    const std::string_view failure = p.text("on_failure");
    settings_.on_failure = failure == "stop"   ? OnFailure::stop
                           : failure == "hold" ? OnFailure::hold
                                               : OnFailure::restart;
    settings_.restarts = std::uint32_t(p.integer("restarts"));
    settings_.limits = {p.real("timeout"), std::uint64_t(p.integer("memory")) << 20};
    settings_.host = &c.host();
    const bool limited = p.real("timeout") != default_timeout || p.integer("memory") != default_memory;
    if (limited && p.text("isolate") != "process")
      c.host().log(
          LogLevel::warning,
          "`timeout` and `memory` bound control code in a process of its own alone; nothing bounds it here: set "
          "`isolate: process`");
    settings_.notes = CallNotes::of(c.host());
  }

  /// Loads the library into this process, or into the first of the separate processes, which is returned.
  std::unique_ptr<ControlProcess> load(bool isolated) {
    if (isolated) {
      auto process = std::make_unique<ControlProcess>(settings_.path, settings_.limits);
      settings_.table = std::move(process->table());
      return process;
    }
    CallNote* const here = settings_.notes ? &settings_.notes->of_this_thread() : nullptr;
    if (here) here->set_library(settings_.path.c_str(), "load");
    settings_.functions = load_library(settings_.path);
    settings_.table = describe(*settings_.functions);
    if (here) here->set_library(nullptr, nullptr);
    return nullptr;
  }

  void tell(Host& host) const {
    const ControlTable& table = settings_.table;
    if (!table.tunables.empty())
      host.log(LogLevel::info, quote(table.name) + " runs with " + shown(table, settings_.tunables));
    if (!table.is_restorable())
      host.log(LogLevel::warning,
               "there can be no snapshots of this run: the instances of " + quote(table.name) + " (" + settings_.path +
                   ") have memory of their own, and its table has no functions `save` and `load`; a reset is possible");
  }

  /// Logs the texts of the first robot that has any: they apply to other robots, too.
  void tell_first(Host& host, LogLevel level, const std::vector<std::string>& (ControlledRobot::*texts)() const) const {
    for (const auto& robot : robots_) {
      const std::vector<std::string>& all = (*robot.*texts)();
      for (const std::string& text : all) host.log(level, text);
      if (!all.empty()) return;
    }
  }

  /// Returns a name that no other controller on the same object has, for any library.
  std::string block_name(const Connector& c, ObjectId object) const {
    const std::string stem = "controller." + settings_.table.name;
    std::string name = stem;
    const auto taken = [&] {
      for (const FoundProperty& p : c.properties(object))
        if (p.key->name == "state." + name) return true;
      return false;
    };
    for (int number = 2; taken(); ++number) name = stem + "." + std::to_string(number);
    return name;
  }

  ControlSettings settings_;
  std::vector<std::unique_ptr<ControlledRobot>> robots_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LibraryController>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_library", .version = description.version, .licence = "MIT",
            .summary = "Control code from shared libraries", .algorithms = algorithms)
