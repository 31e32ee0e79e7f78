// SPDX-License-Identifier: MIT
#include "core/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <mutex>

#include "core/access_check.hpp"
#include "core/inspector.hpp"
#include "core/instance.hpp"
#include "core/levels.hpp"
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
  template <class Work>
  void run(Work work) {
    try {
      work();
    } catch (const SetupError& e) {
      problems_.emplace_back(e.what());
    }
  }
  void check() const {
    if (!problems_.empty()) throw SetupError(problems_);
  }

 private:
  std::vector<std::string> problems_;
};

}  // namespace

class Simulation::Log final : public Host {
 public:
  explicit Log(Inspector& inspector) : inspector_(inspector) {}

  std::function<void(LogLevel, std::string_view)> sink = [](LogLevel level, std::string_view text) {
    if (level >= LogLevel::warning)
      std::fprintf(stderr, "%s: %.*s\n", level == LogLevel::error ? "error" : "warning", int(text.size()), text.data());
  };
  void log(LogLevel level, std::string_view text) noexcept override {
    const std::lock_guard lock(mutex_);
    sink(level, text);
  }
  void* extension(std::string_view name) noexcept override {
    return name == Inspection::extension ? static_cast<Inspection*>(&inspector_) : nullptr;
  }

 private:
  std::mutex mutex_;
  Inspector& inspector_;
};

Simulation::Simulation(Registry& registry, std::uint64_t seed)
    : registry_(registry),
      inspector_(std::make_unique<Inspector>(world_, scheduler_)),
      log_(std::make_unique<Log>(*inspector_)),
      levels_(std::make_unique<Levels>()) {
  scheduler_.set_seed(seed);
}

Simulation::~Simulation() = default;

void Simulation::set_log(std::function<void(LogLevel, std::string_view)> log) { log_->sink = std::move(log); }

namespace {

using Read = std::function<bool(abi::ReaderInstance&, const std::string& path, abi::ErrorText&)>;

/// `what` names the file in messages: "model rover.urdf".
void read_file(Registry& registry, const std::string& path, const std::string& what, const Read& read) {
  if (!std::filesystem::exists(path)) throw SetupError(what + " does not exist");
  abi::ErrorText error;
  abi::ReaderInstance* reader = registry.reader_for(path).create(&error);
  if (!reader) throw SetupError(fmt::format("the reader for {} cannot be created: {}", path, error.view()));
  const bool fine = read(*reader, std::filesystem::absolute(path).string(), error);
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
  read_file(registry_, path, what, [&](abi::ReaderInstance& reader, const std::string& file, abi::ErrorText& error) {
    return reader.read_world(file, world, error);
  });
  world.close();
  check_problems(world.problems(), what);
  return world;
}

std::size_t Simulation::add(AlgorithmSetup setup) {
  if (setup.name.empty()) setup.name = setup.use + " #" + std::to_string(setups_.size());
  if (setup.phase < 0)
    throw SetupError(fmt::format("{}: the phase is {} ns but must be 0 or more", setup.name, setup.phase));
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

void Simulation::merge_batched() {
  instance_of_setup_.clear();
  Collected problems;
  std::vector<AlgorithmSetup> merged;
  const auto world_of = [](const AlgorithmSetup& s) {
    const auto named = s.parameters.find("world");
    return named == s.parameters.end() ? ParameterInput(std::string()) : named->second;
  };
  for (AlgorithmSetup& s : setups_) {
    const std::uint32_t capabilities = registry_.algorithm(s.use).description->capabilities;
    const bool world = (capabilities & Capability::world) != 0, batched = (capabilities & Capability::batched) != 0;
    const auto same = [&](const AlgorithmSetup& m) {
      if (m.use != s.use || m.items.empty()) return false;
      if (world) return world_of(m) == world_of(s);
      return m.name == s.name && m.rate == s.rate && m.phase == s.phase && m.parameters == s.parameters &&
             m.folder == s.folder && m.subsystem == s.subsystem;
    };
    const auto known =
        (batched || world) && !s.items.empty() ? std::find_if(merged.begin(), merged.end(), same) : merged.end();
    if (known != merged.end()) {
      if (world)
        problems.run([&] { join_world(*known, s); });
      else
        known->items.insert(known->items.end(), s.items.begin(), s.items.end());
      instance_of_setup_.push_back(std::size_t(known - merged.begin()));
    } else {
      instance_of_setup_.push_back(merged.size());
      merged.push_back(s);
    }
  }
  problems.check();
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
  if (!instances_.empty()) throw SetupError("a simulation is built once; make another one");
  merge_batched();
  partition_memory();
  levels_->prepare(world_, levels_of_robots_, instances_);
  if (!levels_->empty()) mark_inactive_motions();
  Collected problems;
  for (const std::size_t i : in_order_of(connect_order)) problems.run([&] { instances_[i]->connect(); });
  problems.check();
  for (const std::size_t i : in_order_of(connect_order)) problems.run([&] { instances_[i]->connect_by_name(); });
  problems.check();
  levels_->complete(world_);
  world_.store().check([&](std::string_view key) { return registry_.writers_of(key); });
  schedule();
  initial_ = snapshot();
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->start();
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

void Simulation::run_for(double seconds) { run_until(now() + std::llround(seconds * 1e9)); }

void Simulation::run_until(std::int64_t time, const std::function<bool()>& stop) {
  const auto runs_alone = [](const Task& t) { return t.runs_alone; };
  if (std::none_of(scheduler_.tasks().begin(), scheduler_.tasks().end(), runs_alone))
    return scheduler_.run_until(time, stop);
  inspector_->set_stop(stop);
  scheduler_.run_until(time, [&] { return inspector_->is_stopping(); });
  inspector_->set_stop({});
}

bool Simulation::stopped() const { return inspector_->stopped(); }

void Simulation::refresh() {
  std::vector<TaskId> kinematics;
  for (std::size_t i = 0; i < instances_.size(); ++i)
    if (instances_[i]->description().kind == Kind::kinematics) kinematics.push_back(tasks_[i]);
  scheduler_.run_extra(kinematics);
}

void Simulation::finish() {
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->finish();
}

Snapshot Simulation::snapshot() const { return {world_.store().save(), scheduler_.state()}; }

void Simulation::restore(const Snapshot& snapshot) {
  world_.store().load(snapshot.properties);
  scheduler_.set_state(snapshot.schedule);
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->restored();
}

void Simulation::reset() {
  world_.store().load(initial_.properties);
  scheduler_.set_state(initial_.schedule);
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->start();
}

}  // namespace muro
