// SPDX-License-Identifier: MIT
// Control code from a shared library with the C interface of sdk/c/muro_controller.h; see README.md.
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "connections.hpp"
#include "control_library.hpp"
#include "muro/ext/call_note.hpp"
#include "muro/ext/loaded_libraries.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/random.hpp"
#include "port.hpp"

namespace {

using namespace muro;
using namespace muro::control;

constexpr Parameter parameters[] = {
    text("library", "", "path of the library, or its name: `wander` for wander.so or libwander.so").required(),
    texts("inputs", "what inputs read: \"port=property\", \"port=object:property\"; several properties by commas"),
    texts("outputs", "what outputs write, in the same form"),
    texts("arguments", "\"name=value\", handed to the library"),
};
constexpr PropertyUse reads[] = {{"*", "what the library's inputs are named or connected to"}};
constexpr PropertyUse writes[] = {{"*", "what the library's outputs are named or connected to"},
                                  {"state.controller.*", "the library's state"}};
constexpr Description description{
    .id = "controller.library",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Runs control code from a shared library (C interface, sdk/c/muro_controller.h)",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

constexpr std::size_t error_size = 1024;

/// The state of one robot: this, then the library's own state. The size is a multiple of 64 bytes, so that the states
/// of all robots, one after the other, are aligned as the C header promises.
struct alignas(64) StateBlock {
  std::uint64_t created;  ///< 0 until the library's `create` has run

  void* state() { return this + 1; }
  static std::uint32_t size_for(std::size_t state_size) {
    return std::uint32_t(sizeof(StateBlock) + (state_size + 63) / 64 * 64);
  }
};

class LibraryController final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    read_arguments(p.texts("arguments"));
    const std::string_view name = p.text("library");
    const std::filesystem::path as_path(c.resolve_path(name)), beside_scenario(c.resolve_path("name"));
    path_ = find_library(name, as_path.string(), search_folders(beside_scenario.parent_path().string()));
    notes_ = CallNotes::of(c.host());
    note("load");
    table_ = &load_library(path_);
    note(nullptr);
    if (LoadedLibraries* told = LoadedLibraries::of(c.host()))
      told->add({path_, table_->name, table_->version ? table_->version : ""});
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const Item& item = c.items()[i];
      Robot& r = robots_.emplace_back();
      r.name = item.robot ? item.robot->name : "world";
      r.random_key = c.random_key(i);
      r.block = static_cast<StateBlock*>(
          c.state_block(item.object, block_name(c, item.object), StateBlock::size_for(table_->state_size)));
    }
  }

  void connect_by_name(Connector& c) override {
    const Parameters& p = c.parameters();
    const std::span inputs(table_->inputs, table_->input_count), outputs(table_->outputs, table_->output_count);
    const Connections in = read_connections("inputs", p.texts("inputs"), inputs, table_->name);
    const Connections out = read_connections("outputs", p.texts("outputs"), outputs, table_->name);
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const PropertyFinder finder(c, c.items()[i]);
      for (const muro_port& port : inputs) bind(c, finder, robots_[i], port, in, true);
      for (const muro_port& port : outputs) bind(c, finder, robots_[i], port, out, false);
    }
    for (const auto& [port, robot] : missing_)
      c.host().log(LogLevel::warning, "robot `" + robot + "`: `" + table_->name + "` runs without its input `" + port +
                                          "`, which nothing of the robot provides");
  }

  void start() override {
    for (Robot& r : robots_) {
      std::size_t copied = 0;
      const auto measure = [&](Port& port, const muro_port& wanted, bool input) {
        port.resolve();
        const bool missing = missing_.contains(wanted.name) && port.size() == 0;
        if (wanted.size != 0 && wanted.size != port.size() && !missing)
          throw Error(about(r, wanted, input) + " has " + std::to_string(wanted.size) +
                      " numbers in the library, but the connected properties have " + std::to_string(port.size()));
        copied += port.direct() ? 0 : port.size();
      };
      for (std::uint32_t i = 0; i < table_->input_count; ++i) measure(r.inputs[i], table_->inputs[i], true);
      for (std::uint32_t i = 0; i < table_->output_count; ++i) measure(r.outputs[i], table_->outputs[i], false);
      r.copies.assign(copied, 0);
      double* next = r.copies.data();
      const auto data_of = [&](const Port& port) {
        if (port.direct()) return port.direct();
        return std::exchange(next, next + port.size());
      };
      r.input_sizes.clear(), r.input_data.clear(), r.output_data.clear();
      for (const Port& port : r.inputs) r.input_sizes.push_back(port.size()), r.input_data.push_back(data_of(port));
      for (const Port& port : r.outputs) r.output_data.push_back(data_of(port));
    }
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) run(i, step);
  }

 private:
  /// Which function of the library runs for which robot, for messages about a call that does not return.
  void note(const char* function, std::uint32_t robot = CallNote::no_item) const {
    if (!notes_) return;
    CallNote& here = notes_->of_this_thread();
    here.set_item(robot);
    here.set_library(function ? path_.c_str() : nullptr, function);
  }

  struct Robot {
    std::string name;
    std::uint64_t random_key = 0;
    StateBlock* block = nullptr;
    std::vector<Port> inputs, outputs;
    std::vector<double> copies;  ///< of ports that are not contiguous doubles; written anew in every step, so no state
    std::vector<std::uint32_t> input_sizes;
    std::vector<double*> input_data, output_data;
  };

  std::map<std::string, std::string> missing_;  ///< optional inputs that a robot lacks, and the first such robot

  void read_arguments(std::span<const std::string_view> texts) {
    for (const std::string_view text : texts) {
      const std::size_t equals = text.find('=');
      if (equals == std::string_view::npos || equals == 0)
        throw Error("`arguments`: `" + std::string(text) + "` must be \"name=value\"");
      argument_texts_.emplace_back(text);
    }
    for (const std::string& text : argument_texts_) arguments_.push_back(text.c_str());
    arguments_.push_back(nullptr);
  }

  std::string about(const Robot& r, const muro_port& port, bool input) const {
    return "robot `" + r.name + "`: " + (input ? "input" : "output") + " `" + port.name + "` of `" + table_->name + "`";
  }
  std::string about(const Robot& r) const { return "robot `" + r.name + "`: `" + table_->name + "` "; }

  void bind(Connector& c, const PropertyFinder& finder, Robot& r, const muro_port& port, const Connections& connections,
            bool input) {
    Port& bound = (input ? r.inputs : r.outputs).emplace_back();
    const bool may_be_missing = input && (port.flags & MURO_PORT_OPTIONAL) != 0 && !connections.contains(port.name);
    if (may_be_missing && !finder.has(port.name)) {
      missing_.emplace(port.name, r.name);
      return;
    }
    try {
      for (const FoundProperty& found : finder.find(port, input, connections))
        bound.add(found, input ? const_cast<void*>(c.read_any(found)) : c.write_any(found));
    } catch (const Error& e) {
      throw Error(about(r, port, input) + " cannot be connected: " + e.what());
    }
  }

  /// A name that no other controller on the same object has, whatever library it runs.
  std::string block_name(const Connector& c, ObjectId object) const {
    const std::string stem = "controller." + std::string(table_->name);
    std::string name = stem;
    const auto taken = [&] {
      for (const FoundProperty& p : c.properties(object))
        if (p.key->name == "state." + name) return true;
      return false;
    };
    for (int number = 2; taken(); ++number) name = stem + "." + std::to_string(number);
    return name;
  }

  void create(Robot& r, const Step& step) const {
    char error[error_size] = "";
    if (table_->create) {
      const muro_controller_setup setup{.robot = r.name.c_str(),
                                        .period = step.dt,
                                        .seed = seed_of(step.seed, r.random_key),
                                        .input_sizes = r.input_sizes.data(),
                                        .arguments = arguments_.data()};
      note("create", std::uint32_t(&r - robots_.data()));
      if (table_->create(r.block->state(), &setup, error, error_size) != 0) throw Error(about(r) + failure(error));
    }
    r.block->created = 1;
  }

  static std::uint64_t seed_of(std::uint64_t simulation, std::uint64_t robot) {
    return fnv1a({reinterpret_cast<const char*>(&simulation), sizeof simulation}, robot ^ 0xcbf29ce484222325ull);
  }

  /// Ends the text within the buffer, whatever the library has written.
  static std::string failure(char* error) {
    error[error_size - 1] = 0;
    return *error ? "fails: " + std::string(error) : "fails without giving a reason";
  }

  void run(std::uint32_t number, const Step& step) {
    Robot& r = robots_[number];
    for (std::size_t i = 0; i < r.inputs.size(); ++i)
      if (!r.inputs[i].direct()) r.inputs[i].read(r.input_data[i]);
    for (std::size_t i = 0; i < r.outputs.size(); ++i)
      if (!r.outputs[i].direct()) r.outputs[i].read(r.output_data[i]);
    if (r.block->created == 0) create(r, step);
    const muro_controller_step now{step.seconds(), r.input_data.data(), r.output_data.data()};
    char error[error_size];
    error[0] = 0;
    note("step", number);
    if (table_->step(r.block->state(), &now, error, error_size) != 0) throw Error(about(r) + failure(error));
    note(nullptr, number);
    for (std::size_t i = 0; i < r.outputs.size(); ++i) hand_out(r, i);
  }

  void hand_out(const Robot& r, std::size_t i) const {
    const Port& port = r.outputs[i];
    const double* values = r.output_data[i];
    std::uint32_t bad = 0;
    while (bad < port.size() && std::isfinite(values[bad])) ++bad;
    if (bad == port.size() && (port.direct() || port.write(values, bad))) return;
    char number[32];
    std::snprintf(number, sizeof number, "%.17g", values[bad]);
    throw Error(
        about(r, table_->outputs[i], false) + "[" + std::to_string(bad) + "] is " + number +
        (std::isfinite(values[bad]) ? ", which does not fit into its property" : "; outputs must be finite numbers"));
  }

  std::string path_;  ///< of the library
  CallNotes* notes_ = nullptr;
  const muro_controller_table* table_ = nullptr;
  std::deque<std::string> argument_texts_;
  std::vector<const char*> arguments_;
  std::vector<Robot> robots_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LibraryController>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_library", .version = description.version, .licence = "MIT",
            .summary = "Control code from shared libraries", .algorithms = algorithms)
