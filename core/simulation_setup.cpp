// SPDX-License-Identifier: MIT
// The build of a simulation: from uses of algorithms to tasks of the scheduler.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/algorithm_log.hpp"
#include "core/c_locale.hpp"
#include "core/collected_problems.hpp"
#include "core/extensions.hpp"
#include "core/instance.hpp"
#include "core/levels.hpp"
#include "core/merged_setups.hpp"
#include "core/output_registry.hpp"
#include "core/simulation.hpp"

namespace muro {
namespace {

int connect_order(const Description& d) { return info_of(d.kind).connect_order; }
int order_by_name(const Description& d) { return by_name_order(d.kind); }

bool contains(const std::vector<SlotId>& slots, SlotId slot) {
  return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

}  // namespace

void Simulation::build() {
  const CLocale locale;
  if (built_ || !instances_.empty()) throw SetupError("a simulation is built once; make another one");
  make_instances();
  partition_memory();
  adopt_rates_of_sequences();
  levels_->prepare(world_, levels_of_robots_, instances_);
  if (!levels_->empty()) mark_inactive_motions();
  connect_all();
  levels_->complete(world_);
  check_outputs();
  world_.store().check([&](std::string_view key) { return registry_.writers_of(key); });
  for (const std::size_t i : in_order_of(order_of))
    if (instances_[i]->setup().is_optional) connect_or_leave_out(*instances_[i], &Instance::start);
  schedule();
  initial_ = {world_.store().save(), scheduler_.state()};
  built_ = true;
  extensions_->inputs().set_initial_hash(scheduler_.seeded(world_.hash_of_robots()));
  if (extensions_->requests().is_wanted() || extensions_->inputs().has_recording()) {
    extensions_->requests().want();
    scheduler_.set_one_at_a_time();
  }
  start_all();
  for (const auto& instance : instances_)
    if (auto* const attendant = instance->find_extension<PauseAttendant>())
      extensions_->requests().add_attendant(*attendant);
}

void Simulation::make_instances() {
  MergedSetups setups = merge(setups_, sequences_, registry_);
  instance_of_setup_ = std::move(setups.merged_of_setup);
  CollectedProblems problems;
  for (AlgorithmSetup& m : setups.merged)
    problems.run([&] {
      instances_.push_back(std::make_unique<Instance>(registry_.algorithm(m.use), std::move(m), world_, *log_));
    });
  problems.check();
}

/// Gives algorithms on demand in a sequence the rate of the others. The scheduler refuses a sequence of several rates.
void Simulation::adopt_rates_of_sequences() {
  for (const auto& sequence : sequences_) {
    const auto instance_of = [&](std::size_t a) -> Instance& { return *instances_[instance_of_setup_[a]]; };
    const auto timed = std::find_if(sequence.begin(), sequence.end(),
                                    [&](std::size_t a) { return !instance_of(a).setup().rate.on_demand(); });
    if (timed == sequence.end()) continue;
    const Rate rate = instance_of(*timed).setup().rate;
    for (const std::size_t a : sequence)
      if (instance_of(a).setup().rate.on_demand()) instance_of(a).set_rate(rate);
  }
}

/// Partitions memory by the blocks of robots on which threads work.
void Simulation::partition_memory() {
  const std::vector<std::uint32_t> bounds = block_bounds(std::uint32_t(world_.robots().size()));
  std::vector<std::uint32_t> partitions(world_.object_count(), 0);
  for (std::uint32_t i = 0; i < partitions.size(); ++i)
    if (const RobotId robot = world_.robot_of(ObjectId{i}); robot != no_robot)
      partitions[i] = std::uint32_t(std::upper_bound(bounds.begin(), bounds.end(), index_of(robot)) - bounds.begin());
  world_.store().set_partitions(std::move(partitions));
}

/// Marks for each motion those of its robots that another motion moves at the start.
void Simulation::mark_inactive_motions() {
  for (const auto& instance : instances_) {
    std::vector<bool> inactive(world_.robots().size());
    for (const Item& item : instance->setup().items)
      if (item.robot && instance->description().kind == Kind::motion)
        inactive[index_of(item.robot->id)] = levels_->is_inactive_at_start(item.robot->id, item.level);
    instance->set_inactive_at_start(std::move(inactive));
  }
}

void Simulation::connect_or_leave_out(Instance& instance, void (Instance::*how)()) {
  try {
    (instance.*how)();
  } catch (const SetupError& e) {
    if (!instance.setup().is_optional) throw;
    instance.leave_out();
    log_->log(LogLevel::warning, fmt::format("{}; it is left out", e.what()));
  }
}

/// An algorithm that serves a robot depends on the kinds before it. When one of those has failed, it is left out: it
/// would only report consequences of that failure.
void Simulation::connect_all() {
  CollectedProblems problems;
  std::map<const RobotView*, int> failed;  // the first kind that could not be connected
  const auto connect = [&](void (Instance::*how)(), int (*order_of_kinds)(const Description&)) {
    for (const std::size_t i : in_order_of(order_of_kinds)) {
      Instance& instance = *instances_[i];
      const int order = order_of_kinds(instance.description());
      const std::vector<Item>& items = instance.setup().items;
      const auto follows = [&](const Item& item) { return failed.contains(item.robot) && failed[item.robot] < order; };
      if (instance.is_left_out() || std::any_of(items.begin(), items.end(), follows)) continue;
      outputs().set_owner(world_.store().accessor_name(instance.accessor()));
      if (problems.run([&] { connect_or_leave_out(instance, how); })) continue;
      for (const Item& item : items)
        if (item.robot) failed.emplace(item.robot, order);
    }
    problems.check();
  };
  connect(&Instance::connect, connect_order);
  connect(&Instance::connect_by_name, order_by_name);
}

/// Checks the outputs, also against the files that algorithms and the scene read.
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
  if (outputs_closed_ || inputs_closed_) extensions_->inputs().keep_closed();
  if (outputs_closed_) extensions_->inputs().show_all();
  for (const std::size_t i : in_order_of(order_of)) {
    const Kind kind = instances_[i]->description().kind;
    if (instances_[i]->setup().is_optional) continue;  // it was started already, or is left out
    if (!outputs_closed_ || (kind != Kind::recorder && kind != Kind::view)) instances_[i]->start();
  }
  extensions_->inputs().check_recording();
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
      task.robot_of_item.push_back(item.robot ? item.robot->id : world_.robot_of(item.object));
    task.phases = instance->phases();
    task.accesses = instance->accesses();
    task.robots = std::uint32_t(world_.robots().size());
    task.runs_alone = (instance->description().capabilities & Capability::runs_alone) != 0;
    task.rate = s.rate;
    task.phase = s.phase;
    task.kind = instance->description().kind;
    task.rank = rank_of(instance->description());
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

std::vector<RobotId> Simulation::robot_of_slot() const {
  std::vector<RobotId> robots;
  for (SlotId i = 0; i < world_.store().slot_count(); ++i) {
    const ObjectId object = world_.store().slot(i).object;
    robots.push_back(object == no_object ? no_robot : world_.robot_of(object));
  }
  return robots;
}

}  // namespace muro
