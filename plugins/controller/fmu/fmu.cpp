// SPDX-License-Identifier: MIT
// Functional mock-up units (FMI 2.0 and 3.0, co-simulation) as controllers; see README.md.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>

#include "archive.hpp"
#include "binding.hpp"
#include "input_table.hpp"
#include "muro/ext/external_inputs.hpp"
#include "muro/ext/loaded_libraries.hpp"
#include "muro/plugin.hpp"
#include "once_per_process.hpp"
#include "plugins/common/text/quote.hpp"
#include "start_values.hpp"
#include "stepper.hpp"

namespace {

using namespace muro;
using namespace muro::fmu;

constexpr std::string_view isolations[] = {"none", "process"};
constexpr Parameter parameters[] = {
    text("fmu", "", "path of the FMU; relative ones start at the scenario's folder").required(),
    texts("inputs", "what inputs read: \"variable=property\", \"variable=object:property[vx]\"; several by commas"),
    text("input_file", "", "CSV file: a column `time` in s and one for each input that it gives values over time"),
    texts("outputs", "what outputs write, in the same form"),
    texts("parameters", "\"variable=value\": values before the initialization, in the units of the FMU"),
    text("isolate", "none", "process: the instance of each robot runs in a process of its own").one_of(isolations),
    real("timeout", "s", 30, "of an instance in a process of its own: how long a call may take, by the wall clock")
        .between(1e-3, 1e6),
    boolean("snapshots", true,
            "whether its serialized state is a part of the simulation's; without, the run can be reset, not restored"),
    boolean("logging", false, "whether all messages of the FMU are logged, also those that are no warnings"),
};
constexpr PropertyUse reads[] = {{"*", "what the FMU's inputs are named or connected to"}};
constexpr PropertyUse writes[] = {{"*", "what the FMU's outputs are named or connected to"},
                                  {"state.fmu.*", "the FMU's state, where it can be serialized"}};
constexpr Description description{
    .id = "controller.fmu",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Runs functional mock-up units for co-simulation, FMI 2.0 and 3.0",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = batched,  // other capabilities depend on the FMU
};

/// The state of one robot: this block, then `capacity` bytes for the serialized state of its instance.
struct StateBlock {
  std::uint64_t is_initialized;
  std::int64_t start;  ///< time of the initialization, ns
  std::uint64_t size;  ///< bytes of the serialized state

  std::uint8_t* bytes() { return reinterpret_cast<std::uint8_t*>(this + 1); }
};

class FmuController final : public Algorithm {
 public:
  ~FmuController() override {
    for (Robot& r : robots_) r.log->close();
  }

  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    inputs_from_outside_ = ExternalInputs::of(c.host());
    path_ = c.resolve_path(p.text("fmu"));
    notes_ = CallNotes::of(c.host());
    unpack_and_read(p);
    if (const std::string_view file = p.text("input_file"); !file.empty())
      table_ = std::make_unique<InputTable>(std::string(c.resolve_path(file)), description_);
    is_isolated_ = p.text("isolate") == "process" || (description_.once_per_process && !may_run_here(c));
    if (!is_isolated_) load();
    if (LoadedLibraries* told = LoadedLibraries::of(c.host()))
      told->add({path_, description_.model_name, description_.model_version});
    for (std::uint32_t i = 0; i < c.items().size(); ++i) make_robot(c, i);
    if (!robots_.empty()) named(0, [&] { check_rate(c); });
    state_capacity_ = robots_.empty() ? 0 : measured_state(robots_.front());
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const ObjectId object = c.items()[i].object;
      robots_[i].block = static_cast<StateBlock*>(
          c.state_block(object, block_name(c, object), std::uint32_t(sizeof(StateBlock) + state_capacity_)));
    }
    if (!saves_state_)
      c.host().log(LogLevel::info,
                   file_name() + " " + why_not_saved() + ": the run can be reset, but not restored to a snapshot");
  }

  void connect_by_name(Connector& c) override {
    const Parameters& p = c.parameters();
    const Mapping inputs = read_mapping("inputs", p.texts("inputs"), description_);
    const Mapping outputs = read_mapping("outputs", p.texts("outputs"), description_);
    check_given_once(inputs);
    Binder binder(c, description_, inputs, outputs, [&](std::size_t variable) { return has_value(variable); });
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      named(i, [&] { binder.bind(c.items()[i], robots_[i].inputs, robots_[i].outputs); });
    if (!robots_.empty() && robots_.front().outputs.is_empty())
      c.host().log(LogLevel::warning, file_name() + ": none of its outputs is connected to anything; name some in " +
                                          "`outputs`, as in [\"variable=command.twist[vx]\"]");
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::reads_all, true}};
    return phases;
  }

  void start() override {
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      named(i, [&] {
        robots_[i].inputs.resolve();
        robots_[i].outputs.resolve();
        robots_[i].is_stale = true;
      });
  }

  void restored() override {
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      named(i, [&] {
        if (robots_[i].block->is_initialized != 0 && !saves_state_)
          throw Error("it " + why_not_saved() + ", so its state at that time is lost; a reset starts it anew");
        robots_[i].is_stale = true;
      });
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) named(i, [&] { run(robots_[i], step); });
  }

 private:
  struct Robot {
    std::string name;
    std::unique_ptr<MessageLog> log;
    std::unique_ptr<Component> component;
    Exchange inputs, outputs;
    StateBlock* block = nullptr;
    std::vector<std::uint64_t> room;  ///< for values of the input file
    bool is_new = true;               ///< the instance was only instantiated or reset
    bool is_stale = false;            ///< the instance does not match the block
  };

  std::string file_name() const { return std::filesystem::path(path_).filename().string(); }

  /// Runs `work` for a robot. Adds the names of robot and FMU to its errors.
  template <class Work>
  void named(std::uint32_t robot, Work work) {
    CallNote* const note = notes_ ? &notes_->of_this_thread() : nullptr;
    if (note) note->set_item(robot);
    try {
      work();
    } catch (const Error& e) {
      const std::string text = "robot `" + robots_[robot].name + "`: " + file_name() + ": " + e.what();
      const bool is_from_outside = dynamic_cast<const FailureFromOutside*>(&e) != nullptr;
      if (is_from_outside && inputs_from_outside_) inputs_from_outside_->not_repeatable(text);
      throw Error(text);
    }
    if (note) note->set_item(CallNote::no_item);
  }

  void unpack_and_read(const Parameters& p) {
    folder_.create();
    std::vector<std::string> platforms = own_platforms(2);
    for (const std::string& other : own_platforms(3)) platforms.push_back(other);
    const Archive archive = unpack(path_, folder_.path(), platforms);
    description_ = read_model_description(archive.description, path_);
    saves_state_ = description_.can_serialize_state && p.boolean("snapshots");
    start_values_ = read_start_values(p.texts("parameters"), description_);
    set_sizes(description_, start_values_);
    if (archive.has_resources) resources_ = folder_.path() / "resources";
    for (const std::string& platform : own_platforms(description_.version)) {
      library_ = folder_.path() / "binaries" / platform / (description_.identifier + ".so");
      if (std::filesystem::is_regular_file(library_)) return;
    }
    fail_without_library(archive);
  }

  [[noreturn]] void fail_without_library(const Archive& archive) const {
    const std::string platform = own_platforms(description_.version).front();
    const std::string wanted = "binaries/" + platform + "/" + description_.identifier + ".so";
    std::set<std::string> there;
    std::error_code none;
    for (const auto& file : std::filesystem::directory_iterator(folder_.path() / "binaries" / platform, none))
      there.insert(file.path().filename().string());
    if (!there.empty())
      throw Error(path_ + " holds no " + wanted +
                  ", where modelIdentifier says that its library is; that folder holds " + quoted_list(there));
    const std::vector<std::string_view> others(archive.platforms.begin(), archive.platforms.end());
    throw Error(path_ + " holds no library for this machine, " + wanted +
                "; it holds folders for: " + quoted_list(others) + ". Export it for Linux on this processor");
  }

  void load() {
    CallNote* const note = notes_ ? &notes_->of_this_thread() : nullptr;
    if (note) note->set_library(path_.c_str(), "load");
    try {
      binary_ = std::make_unique<Binary>(library_);
    } catch (const Error& e) {
      throw Error(path_ + ": " + e.what());
    }
    if (note) note->set_library(nullptr, nullptr);
  }

  /// Whether one instance is enough, and is the only one in this process.
  bool may_run_here(const Connector& c) {
    return c.items().size() <= 1 && claim_.claim(description_.identifier + " " + description_.token);
  }

  void make_robot(Connector& c, std::uint32_t i) {
    const Item& item = c.items()[i];
    Robot& r = robots_.emplace_back();
    r.name = item.robot ? item.robot->name : "world";
    r.log = std::make_unique<MessageLog>(c.host(), r.name, c.parameters().boolean("logging"));
    named(i, [&] {
      Component::Setup setup;
      setup.description = &description_;
      setup.binary = binary_.get();
      setup.library = library_;
      setup.timeout = c.parameters().real("timeout");
      setup.resources = resources_;
      setup.name = r.name;
      setup.notes = notes_;
      setup.log = r.log.get();
      if (table_) r.room.resize(table_->room());
      r.component = is_isolated_ ? make_remote_component(setup) : make_component(setup);
      r.component->instantiate();
    });
  }

  /// Returns the size reserved for a state: 1.5 times the size after the initialization, and 1 KiB.
  std::size_t measured_state(Robot& r) {
    std::size_t size = 0;
    if (saves_state_)
      named(0, [&] {
        r.is_new = false;
        set_start_values(*r.component, description_, start_values_);
        r.component->enter_initialization(0);
        r.component->exit_initialization();
        r.component->keep_state();
        size = r.component->state_size();
      });
    constexpr std::size_t most = 256u << 20;
    if (size > most)
      throw Error(path_ + ": its state has " + std::to_string(size) + " bytes; at most " + std::to_string(most) +
                  " are kept");
    return size == 0 ? 0 : (size + size / 2 + 1024) / 8 * 8;
  }

  /// Whether an input needs no property, because another source gives its value.
  bool has_value(std::size_t variable) const {
    return start_values_.contains(variable) || (table_ && table_->has(variable));
  }

  void check_given_once(const Mapping& inputs) const {
    for (const auto& [variable, references] : inputs)
      if (table_ && table_->has(variable))
        throw Error(table_->path() + " has a column " + quote(description_.variables[variable].name) +
                    ", and `inputs` connects it, too; leave out one of them");
  }

  /// `time` (s): time of the values from the input file.
  void set_inputs(Robot& r, double time) {
    r.inputs.set(*r.component);
    if (table_) table_->set(*r.component, time, r.room);
  }

  /// Returns a name that no other controller on the same object has.
  std::string block_name(const Connector& c, ObjectId object) const {
    const std::string stem = "fmu." + description_.identifier;
    std::string name = stem;
    const auto is_taken = [&] {
      for (const FoundProperty& p : c.properties(object))
        if (p.key->name == "state." + name) return true;
      return false;
    };
    for (int number = 2; is_taken(); ++number) name = stem + "." + std::to_string(number);
    return name;
  }

  /// Advances the FMU from the last instant to this one, so that its time is the time of the simulation. Communication
  /// points are multiples of the period after the start, without the rounding to nanoseconds.
  void run(Robot& r, const Step& step) {
    if (r.is_stale) synchronise(r);
    if (r.block->is_initialized == 0) {
      r.is_new = false;
      set_start_values(*r.component, description_, start_values_);
      r.component->enter_initialization(step.seconds());
      set_inputs(r, step.seconds());
      r.component->exit_initialization();
      r.block->start = step.time;
      r.block->is_initialized = 1;
    } else {
      const double start = 1e-9 * double(r.block->start);
      const double periods = std::round(1e-9 * double(step.time - r.block->start) / step.dt);
      const double before = start + (periods - 1) * step.dt;
      set_inputs(r, before);
      advance(*r.component, description_, before, start + periods * step.dt, step.dt, [&] { set_inputs(r, before); });
    }
    r.outputs.get(*r.component);
    if (saves_state_) save(r);
  }

  std::string why_not_saved() const {
    return description_.can_serialize_state ? "is not saved (`snapshots` is false)"
                                            : "lacks the flag " + description_.flag_of_state("Serialize");
  }

  void check_rate(const Connector& c) const {
    if (c.rate() == 0) {
      if (description_.fixed_internal_step > 0)
        throw Error("it runs on demand, and has a fixedInternalStepSize; give it a `rate`");
      return;
    }
    const double period = 1 / c.rate();
    check_step_size(description_, period);
    if (const std::string advice = advice_on_step_size(description_, period); !advice.empty())
      c.host().log(LogLevel::warning, file_name() + ": " + advice);
  }

  void synchronise(Robot& r) {
    if (r.block->is_initialized != 0) {
      r.component->read_state({r.block->bytes(), std::size_t(r.block->size)});
      r.is_new = false;
    } else if (!r.is_new) {
      r.component->reset();
      r.is_new = true;
    }
    r.is_stale = false;
  }

  void save(Robot& r) const {
    r.component->keep_state();
    const std::size_t size = r.component->state_size();
    if (size > state_capacity_)
      throw Error("its state has grown to " + std::to_string(size) + " bytes; it had two thirds of " +
                  std::to_string(state_capacity_) +
                  " after the initialization, and that much has been set aside for it");
    r.component->write_state({r.block->bytes(), size});
    if (size < r.block->size) std::memset(r.block->bytes() + size, 0, r.block->size - size);
    r.block->size = size;
  }

  std::string path_;
  CallNotes* notes_ = nullptr;
  ExternalInputs* inputs_from_outside_ = nullptr;
  PrivateFolder folder_;
  ModelDescription description_;
  std::filesystem::path library_, resources_;
  bool saves_state_ = false;
  bool is_isolated_ = false;  ///< each instance is in a separate process
  std::unique_ptr<Binary> binary_;
  ProcessClaim claim_;
  StartValues start_values_;
  std::unique_ptr<InputTable> table_;  ///< null: there is no input file
  std::size_t state_capacity_ = 0;
  std::vector<Robot> robots_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<FmuController>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_fmu", .version = description.version, .licence = "MIT",
            .summary = "Functional mock-up units as controllers", .algorithms = algorithms)
