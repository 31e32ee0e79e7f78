// SPDX-License-Identifier: MIT
#include "core/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <unordered_map>

#include "core/access_check.hpp"
#include "core/c_locale.hpp"
#include "core/extensions.hpp"
#include "core/instance.hpp"
#include "core/levels.hpp"
#include "core/output_registry.hpp"
#include "core/simulated_time.hpp"
#include "muro/toolkit/printable.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

namespace {

int connect_order(const Description& d) { return info_of(d.kind).connect_order; }

bool contains(const std::vector<SlotId>& slots, SlotId slot) {
  return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

/// Lets several steps of the set-up fail, so that all their problems are reported at once.
class Collected {
 public:
  /// Whether `work` has succeeded.
  template <class Work>
  bool run(Work work) {
    try {
      work();
    } catch (const SetupError& e) {
      problems_.emplace_back(e.what());
      return false;
    }
    return true;
  }
  void check() const {
    if (!problems_.empty()) throw SetupError(problems_);
  }

 private:
  std::vector<std::string> problems_;
};

}  // namespace

/// Hands on what algorithms say, with who says it.
class Simulation::Log final : public Host {
 public:
  explicit Log(Extensions& extensions) : extensions_(extensions) {}

  std::function<void(LogLevel, std::string_view)> sink = [](LogLevel level, std::string_view text) {
    if (level >= LogLevel::warning)
      std::fprintf(stderr, "%s: %.*s\n", level == LogLevel::error ? "error" : "warning", int(text.size()), text.data());
  };
  void log(LogLevel level, std::string_view text) noexcept override {
    const std::string line = printable(by_whom(text) + std::string(text), "\n\t");
    const std::lock_guard lock(mutex_);
    sink(level, line);
  }
  void* extension(std::string_view name_and_version) noexcept override { return extensions_.find(name_and_version); }
  void* find_extension(const ExtensionId& id) noexcept override {
    std::string why_not;
    void* found = extensions_.find(id, why_not);
    if (!why_not.empty()) log(LogLevel::warning, why_not);
    return found;
  }

 private:
  /// "urban.yaml:14:7: rovers.control (controller.library), robot `rover_3`, t = 0.500000 s: "; empty outside of calls.
  static std::string by_whom(std::string_view text) {
    const RunningCall& call = running_call();
    if (!call.callee.load()) return "";
    std::string line = who(call, text);
    if (const std::int64_t time = call.time.load(); time != RunningCall::no_time)
      line += fmt::format("{} t = {:f} s", line.ends_with(',') ? "" : ",", 1e-9 * double(time));
    if (line.ends_with(',')) line.pop_back();
    return line + ": ";
  }

  std::mutex mutex_;
  Extensions& extensions_;
};

Simulation::Simulation(Registry& registry, std::uint64_t seed)
    : registry_(registry),
      extensions_(std::make_unique<Extensions>(world_, scheduler_)),
      log_(std::make_unique<Log>(*extensions_)),
      levels_(std::make_unique<Levels>()) {
  scheduler_.set_seed(seed);
}

Simulation::~Simulation() = default;

void Simulation::set_log(std::function<void(LogLevel, std::string_view)> log) { log_->sink = std::move(log); }

namespace {

using Read = std::function<bool(abi::ReaderInstance&, const std::string& path, abi::ErrorText&)>;

/// `what` names the file in messages: "model rover.urdf".
void read_file(Registry& registry, const std::string& path, const std::string& what, const Read& read) {
  const CLocale locale;
  std::error_code code;
  const bool exists = std::filesystem::exists(path, code);
  if (code) throw SetupError(fmt::format("{} cannot be read: {}", what, code.message()));
  if (!exists) throw SetupError(what + " does not exist");
  abi::ErrorText error;
  abi::ReaderInstance* reader = registry.reader_for(path).create(&error);
  if (!reader) throw SetupError(fmt::format("the reader for {} cannot be created: {}", path, error.view()));
  const Callee callee{.name = what};
  const CallScope scope(callee, "read");
  const std::string absolute = std::filesystem::absolute(path, code).string();
  const bool fine = read(*reader, code ? path : absolute, error);
  reader->destroy();
  if (!fine) throw SetupError(fmt::format("{}: {}", what, error.view()));
}

void check_problems(const std::vector<RobotTree::Problem>& found, const std::string& what) {
  std::vector<std::string> problems;
  for (const RobotTree::Problem& p : found)
    if (p.severity == Severity::error)
      problems.push_back(p.line > 0 ? fmt::format("{}:{}:{}: {}", what, p.line, p.column, p.text)
                                    : fmt::format("{}: {}", what, p.text));
  if (!problems.empty()) throw SetupError(problems);
}

}  // namespace

RobotTree Simulation::read_model(const std::string& path) {
  RobotTree tree;
  const std::string what = "model " + path;
  outputs().add_input(path, "a model");
  read_file(registry_, path, what, [&](abi::ReaderInstance& reader, const std::string& file, abi::ErrorText& error) {
    return reader.read(file, tree, error);
  });
  if (tree.usable()) tree.close();
  check_problems(tree.problems(), what);
  return tree;
}

WorldModel Simulation::read_world(const std::string& path) {
  WorldModel world;
  const std::string what = "world " + path;
  outputs().add_input(path, "the world file");
  read_file(registry_, path, what, [&](abi::ReaderInstance& reader, const std::string& file, abi::ErrorText& error) {
    return reader.read_world(file, world, error);
  });
  world.close();
  check_problems(world.problems(), what);
  return world;
}

std::size_t Simulation::add(AlgorithmSetup setup) {
  if (setup.name.empty()) setup.name = setup.use + " #" + std::to_string(setups_.size());
  check_time(setup.phase, fmt::format("{}: the phase", setup.name));
  setups_.push_back(std::move(setup));
  return setups_.size() - 1;
}

std::size_t Simulation::use(const std::string& id, double rate, std::vector<Item> items,
                            std::map<std::string, ParameterInput> parameters) {
  AlgorithmSetup s;
  s.use = id;
  s.subsystem = id;
  s.rate = Rate(rate);
  s.items = std::move(items);
  s.parameters = std::move(parameters);
  return add(std::move(s));
}

ObjectId Simulation::add_sensor_object(const RobotView& robot, std::string_view name, ObjectId link) {
  const ObjectId sensor = world_.add_object(std::string(robot.name) + "/" + std::string(name), robot.number);
  world_.share(sensor, keys::pose, link, keys::pose);
  world_.share(sensor, keys::twist, link, keys::twist);
  return sensor;
}

void Simulation::set_levels(const RobotView& robot, std::vector<std::string> names, std::uint32_t first) {
  if (first >= names.size())
    throw SetupError(
        fmt::format("`{}` has {} motions, so it cannot start with number {}", robot.name, names.size(), first));
  levels_of_robots_.push_back({&robot, std::move(names), first});
}

/// Tells each motion which of its robots another one moves at the start.
void Simulation::mark_inactive_motions() {
  for (const auto& instance : instances_) {
    std::vector<bool> inactive(world_.robots().size());
    for (const Item& item : instance->setup().items)
      if (item.robot && instance->description().kind == Kind::motion)
        inactive[item.robot->number] = levels_->is_inactive_at_start(std::int32_t(item.robot->number), item.level);
    instance->set_inactive_at_start(std::move(inactive));
  }
}

/// Robots of one world share an instance; each keeps its parameters.
void Simulation::join_world(AlgorithmSetup& world, AlgorithmSetup& joining) const {
  if (world.rate != joining.rate || world.phase != joining.phase)
    throw SetupError(
        fmt::format("{}{} and {} share a world of {} but have different rates or phases; give them the "
                    "same, or another `world` to one of them",
                    prefix_of(joining.place), joining.name, world.name, joining.use));
  for (const Item& item : joining.items)
    if (std::any_of(world.items.begin(), world.items.end(), [&](const Item& k) { return k.robot == item.robot; }))
      throw SetupError(
          fmt::format("{}{} and {} would move one robot in one world of {}; give one of them another `world`",
                      prefix_of(joining.place), joining.name, world.name, joining.use));
  world.item_setups.resize(world.items.size(), {world.name, world.place, world.parameters});
  world.items.insert(world.items.end(), joining.items.begin(), joining.items.end());
  world.item_setups.resize(world.items.size(), {joining.name, joining.place, joining.parameters});
}

/// Of a kind whose results would mix, one algorithm serves an object, and one that serves the world serves all.
void Simulation::check_single_roles(const std::vector<AlgorithmSetup>& setups) const {
  std::map<std::pair<Kind, ObjectId>, const AlgorithmSetup*> served;
  std::set<std::pair<const AlgorithmSetup*, const AlgorithmSetup*>> told;
  std::vector<std::string> problems;
  const auto conflict = [&](const AlgorithmSetup& s, const AlgorithmSetup& other, const KindInfo& kind) {
    if (&s == &other || !told.emplace(&other, &s).second) return;
    const std::string place = other.place.empty() ? "" : " at " + other.place;
    problems.push_back(
        fmt::format("{}{} ({}) is of kind {}, and so is {} ({}){}: their results would mix; remove one of them",
                    prefix_of(s.place), s.name, s.use, kind.name, other.name, other.use, place));
  };
  for (const AlgorithmSetup& s : setups) {
    const KindInfo& kind = info_of(registry_.algorithm(s.use).description->kind);
    if (!kind.is_single) continue;
    if (s.items.empty()) {
      const auto any = served.lower_bound({kind.kind, world_object});
      if (any != served.end() && any->first.first == kind.kind) conflict(s, *any->second, kind);
      served.emplace(std::pair(kind.kind, world_object), &s);
    }
    const auto all = served.find({kind.kind, world_object});
    for (const Item& item : s.items)
      conflict(
          s, all != served.end() ? *all->second : *served.emplace(std::pair(kind.kind, item.object), &s).first->second,
          kind);
  }
  if (!problems.empty()) throw SetupError(problems);
}

void Simulation::merge_batched() {
  instance_of_setup_.clear();
  Collected problems;
  std::vector<AlgorithmSetup> merged;
  const auto world_of = [](const AlgorithmSetup& s) {
    const auto named = s.parameters.find("world");
    return named == s.parameters.end() ? ParameterInput(std::string()) : named->second;
  };
  std::unordered_map<std::string, std::vector<std::size_t>> alike;  // merged, by algorithm and the name they go by
  for (AlgorithmSetup& s : setups_) {
    const std::uint32_t capabilities = registry_.algorithm(s.use).description->capabilities;
    const bool world = (capabilities & Capability::world) != 0, batched = (capabilities & Capability::batched) != 0;
    const auto same = [&](const AlgorithmSetup& m) {
      if (m.use != s.use || m.items.empty()) return false;
      if (world) return world_of(m) == world_of(s);
      return m.name == s.name && m.rate == s.rate && m.phase == s.phase && m.parameters == s.parameters &&
             m.folder == s.folder && m.subsystem == s.subsystem;
    };
    const ParameterInput in_world = world_of(s);
    const std::string* world_name = std::get_if<std::string>(&in_world);
    std::vector<std::size_t>& candidates = alike[s.use + '\n' +
                                                 (!world       ? s.name
                                                  : world_name ? *world_name
                                                               : std::string())];
    const auto known =
        (batched || world) && !s.items.empty()
            ? std::find_if(candidates.begin(), candidates.end(), [&](std::size_t m) { return same(merged[m]); })
            : candidates.end();
    if (known != candidates.end()) {
      AlgorithmSetup& m = merged[*known];
      if (world)
        problems.run([&] { join_world(m, s); });
      else
        m.items.insert(m.items.end(), s.items.begin(), s.items.end());
      instance_of_setup_.push_back(*known);
    } else {
      candidates.push_back(merged.size());
      instance_of_setup_.push_back(merged.size());
      merged.push_back(s);
    }
  }
  problems.check();
  check_single_roles(merged);
  for (AlgorithmSetup& m : merged)
    problems.run([&] {
      instances_.push_back(std::make_unique<Instance>(registry_.algorithm(m.use), std::move(m), world_, *log_));
    });
  problems.check();
}

std::vector<std::size_t> Simulation::in_order_of(int (*order)(const Description&)) const {
  std::vector<std::size_t> all(instances_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return order(instances_[a]->description()) < order(instances_[b]->description());
  });
  return all;
}

/// By the blocks of robots that threads work on.
void Simulation::partition_memory() {
  const std::vector<std::uint32_t> bounds = block_bounds(std::uint32_t(world_.robots().size()));
  std::vector<std::uint32_t> partitions(world_.object_count(), 0);
  for (std::uint32_t i = 0; i < partitions.size(); ++i)
    if (const std::int32_t robot = world_.robot_of(ObjectId{i}); robot >= 0)
      partitions[i] =
          std::uint32_t(std::upper_bound(bounds.begin(), bounds.end(), std::uint32_t(robot)) - bounds.begin());
  world_.store().set_partitions(std::move(partitions));
}

void Simulation::build() {
  const CLocale locale;
  if (built_ || !instances_.empty()) throw SetupError("a simulation is built once; make another one");
  merge_batched();
  partition_memory();
  levels_->prepare(world_, levels_of_robots_, instances_);
  if (!levels_->empty()) mark_inactive_motions();
  connect_all();
  levels_->complete(world_);
  check_outputs();
  world_.store().check([&](std::string_view key) { return registry_.writers_of(key); });
  schedule();
  initial_ = {world_.store().save(), scheduler_.state()};
  built_ = true;
  start_all();
}

/// What serves a robot builds on the kinds before it: where one of those has failed, it would only find what follows
/// from that, and is left out.
void Simulation::connect_all() {
  Collected problems;
  std::map<const RobotView*, int> failed;  // the first kind that could not be connected
  const auto connect = [&](void (Instance::*how)()) {
    for (const std::size_t i : in_order_of(connect_order)) {
      Instance& instance = *instances_[i];
      const int order = connect_order(instance.description());
      const std::vector<Item>& items = instance.setup().items;
      const auto follows = [&](const Item& item) { return failed.contains(item.robot) && failed[item.robot] < order; };
      if (std::any_of(items.begin(), items.end(), follows)) continue;
      outputs().set_owner(world_.store().accessor_name(instance.accessor()));
      if (problems.run([&] { (instance.*how)(); })) continue;
      for (const Item& item : items)
        if (item.robot) failed.emplace(item.robot, order);
    }
    problems.check();
  };
  connect(&Instance::connect);
  connect(&Instance::connect_by_name);
}

OutputRegistry& Simulation::outputs() { return extensions_->outputs(); }

/// Also with what algorithms and the scene read.
void Simulation::check_outputs() {
  OutputRegistry& all = outputs();
  if (all.empty()) return;
  for (const auto& instance : instances_) {
    const std::string& who = world_.store().accessor_name(instance->accessor());
    all.set_owner(who);
    for (const std::string& path : instance->resolved_paths()) all.add_input(path, fmt::format("which {} reads", who));
    const CatalogEntry& plugin = registry_.find(instance->setup().use);
    for (const std::string& path : {plugin.library, plugin.description})
      all.add_input(path, fmt::format("a file of the plugin {}", plugin.plugin));
  }
  all.set_owner("the scene");
  for (std::size_t i = 0; i < world_.text_count(); ++i)
    if (const std::string text(world_.text(TextId(std::uint32_t(i)))); text.find('/') != std::string::npos)
      all.add_input(text, "a file of the scene");
  all.check();
}

void Simulation::start_all() {
  for (const std::size_t i : in_order_of(order_of)) {
    const Kind kind = instances_[i]->description().kind;
    if (!outputs_closed_ || (kind != Kind::recorder && kind != Kind::view)) instances_[i]->start();
  }
}

void Simulation::schedule() {
  std::vector<const Instance*> by_accessor;
  for (const auto& instance : instances_) {
    by_accessor.resize(std::max<std::size_t>(by_accessor.size(), instance->accessor() + 1));
    by_accessor[instance->accessor()] = instance.get();
  }
  for (const auto& instance : instances_) instance->add_indirect_reads(by_accessor);
  const std::vector<SlotId> written_by_handover = levels_->written();
  for (const auto& instance : instances_) {
    const AlgorithmSetup& s = instance->setup();
    Task task;
    task.name = s.name;
    task.callee = instance->callee();
    task.instance = levels_->filter_of(*instance);
    task.items = std::uint32_t(s.items.size());
    for (const Item& item : s.items)
      task.robot_of_item.push_back(item.robot ? std::int32_t(item.robot->number) : world_.robot_of(item.object));
    task.phases = instance->phases();
    task.accesses = instance->accesses();
    task.robots = std::uint32_t(world_.robots().size());
    task.runs_alone = (instance->description().capabilities & Capability::runs_alone) != 0;
    task.rate = s.rate;
    task.phase = s.phase;
    task.order = order_of(instance->description());
    task.reads = instance->reads();
    if (instance->description().kind == Kind::level)
      std::erase_if(task.reads, [&](SlotId slot) { return contains(written_by_handover, slot); });
    task.writes = instance->writes();
    tasks_.push_back(scheduler_.add(std::move(task)));
  }
  if (!levels_->empty()) scheduler_.add(levels_->task(instances_));
  for (const auto& sequence : sequences_) {
    std::vector<TaskId> ids;
    for (const std::size_t a : sequence) {
      const TaskId t = tasks_[instance_of_setup_[a]];
      if (std::find(ids.begin(), ids.end(), t) == ids.end()) ids.push_back(t);
    }
    scheduler_.add_sequence(ids);
  }
  scheduler_.set_slots(robot_of_slot());
  scheduler_.prepare();
}

std::vector<std::int32_t> Simulation::robot_of_slot() const {
  std::vector<std::int32_t> robots;
  for (SlotId i = 0; i < world_.store().slot_count(); ++i) {
    const ObjectId object = world_.store().slot(i).object;
    robots.push_back(object == no_object ? -1 : world_.robot_of(object));
  }
  return robots;
}

void Simulation::verify_access() {
  std::vector<Instance*> instances;
  for (const auto& i : instances_) instances.push_back(i.get());
  scheduler_.executor().set_observer(std::make_unique<AccessCheck>(world_.store(), instances, robot_of_slot()));
}

void Simulation::require_built(const char* call) const {
  if (!built_) throw SetupError(fmt::format("{} is called before build(), which connects what is to run", call));
}

void Simulation::set_threads(unsigned threads) {
  const std::string reason = scheduler_.set_threads(threads);
  if (!reason.empty())
    log_->log(LogLevel::warning,
              fmt::format("only {} of {} threads can be started ({}); the run goes on with these, and "
                          "its results are the same",
                          scheduler_.executor().threads(), threads, reason));
}

void Simulation::set_pacing(Pacing pacing) {
  if (pacing.factor != 0 && !(pacing.factor >= 1e-6 && pacing.factor <= 1e6))
    throw SetupError(
        fmt::format("a run at {} times real time is not possible; allowed are 1e-6 to 1e6, or 0 for as fast as it goes",
                    pacing.factor));
  scheduler_.set_pacing(pacing);
}

void Simulation::run_for(double seconds) { run_until(now() + nanoseconds_of(seconds, "the duration of a run")); }

void Simulation::run_until(std::int64_t time, const std::function<bool()>& stop) {
  require_built("run_until()");
  const CLocale locale;
  check_time(time, "the end of a run");
  if (outputs_closed_) throw SetupError("a simulation that keeps its outputs closed cannot run");
  const auto runs_alone = [](const Task& t) { return t.runs_alone; };
  if (std::none_of(scheduler_.tasks().begin(), scheduler_.tasks().end(), runs_alone))
    return scheduler_.run_until(time, stop);
  Inspector& inspector = extensions_->inspector();
  inspector.set_stop(stop);
  scheduler_.run_until(time, [&] { return inspector.is_stopping(); });
  inspector.set_stop({});
}

bool Simulation::stopped() const { return extensions_->inspector().stopped(); }

std::vector<UsedLibrary> Simulation::libraries() const {
  std::vector<UsedLibrary> all = registry_.loaded();
  all.insert(all.end(), extensions_->libraries().begin(), extensions_->libraries().end());
  return all;
}

void Simulation::refresh() {
  require_built("refresh()");
  const CLocale locale;
  std::vector<TaskId> kinematics;
  for (std::size_t i = 0; i < instances_.size(); ++i)
    if (instances_[i]->description().kind == Kind::kinematics) kinematics.push_back(tasks_[i]);
  scheduler_.run_extra(kinematics);
}

void Simulation::finish() {
  require_built("finish()");
  const CLocale locale;
  Collected problems;  // one that fails keeps no other from its files
  for (const std::size_t i : in_order_of(order_of)) problems.run([&] { instances_[i]->finish(); });
  problems.check();
}

Snapshot Simulation::snapshot() const {
  require_built("snapshot()");
  return {world_.store().save(), scheduler_.state()};
}

void Simulation::restore(const Snapshot& snapshot) {
  require_built("restore()");
  const CLocale locale;
  world_.store().load(snapshot.properties);
  scheduler_.set_state(snapshot.schedule);
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->restored();
}

void Simulation::reset() {
  require_built("reset()");
  const CLocale locale;
  world_.store().load(initial_.properties);
  scheduler_.set_state(initial_.schedule);
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->start();
}

}  // namespace muro
