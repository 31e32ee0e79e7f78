// SPDX-License-Identifier: MIT
#include "core/schedule/scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "muro/description.hpp"

namespace muro {

namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
bool observes(const Task& task) { return task.writes.empty() || task.part() == InstantPart::observes; }

}  // namespace

void Rate::refuse(double hertz) {
  throw SetupError(
      fmt::format("a rate of {} Hz is not possible; allowed is 1e-6 to 1e9 Hz, or 0 for on demand", hertz));
}

TaskId Scheduler::add(Task task) {
  const auto id = TaskId(tasks_.size());
  if (!task.callee) task.callee = std::make_shared<Callee>(Callee{.name = task.name});
  tasks_.push_back(std::move(task));
  runs_.push_back(0);
  items_.push_back({id});
  item_of_.push_back(std::int32_t(items_.size()) - 1);
  prepared_ = false;
  return id;
}

void Scheduler::add_sequence(const std::vector<TaskId>& tasks) {
  const auto timed = std::find_if(tasks.begin(), tasks.end(), [&](TaskId t) { return !tasks_[t].rate.on_demand(); });
  if (timed == tasks.end())
    throw SetupError(fmt::format("the sequence that begins with `{}` has no rate: all of it runs on demand",
                                 tasks_[tasks.front()].name));
  const Task& first = tasks_[*timed];
  for (const TaskId t : tasks)
    if (!tasks_[t].rate.on_demand() && (tasks_[t].rate != first.rate || tasks_[t].phase != first.phase))
      throw SetupError(
          fmt::format("a sequence runs at one rate, but `{}` and `{}` have different rates or phases; give "
                      "them the same, or leave one out",
                      first.name, tasks_[t].name));
  const Rate rate = first.rate;
  const std::int64_t phase = first.phase;
  for (const TaskId t : tasks) {
    std::vector<TaskId>& item = items_[std::size_t(item_of_[t])];
    item.erase(std::remove(item.begin(), item.end(), t), item.end());
    item_of_[t] = std::int32_t(items_.size());
    tasks_[t].rate = rate;
    tasks_[t].phase = phase;
  }
  items_.push_back(tasks);
  prepared_ = false;
}

void Scheduler::prepare() {
  prepared_ = true;
  forget_plans();
  executor_.set_tasks(tasks_.size());
  groups_.clear();
  group_of_item_.assign(items_.size(), 0);
  min_period_ = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].empty() || tasks_[items_[i].front()].rate.on_demand()) continue;
    const Task& t = tasks_[items_[i].front()];
    auto g = std::find_if(groups_.begin(), groups_.end(),
                          [&](const Group& k) { return k.rate == t.rate && k.phase == t.phase; });
    if (g == groups_.end()) {
      Group group{t.rate, t.phase, t.rate.first_from(now_ - t.phase), 0};
      group.next_time = group.rate.time_of(group.next_run) + group.phase;
      groups_.push_back(group);
      g = groups_.end() - 1;
      const auto period = std::int64_t(1e9 * t.rate.period());
      min_period_ = min_period_ == 0 ? period : std::min(min_period_, period);
    }
    group_of_item_[i] = std::uint32_t(g - groups_.begin());
  }
  due_.assign(groups_.size(), false);
  next_due_ = due_;
  find_providers();
  find_step_tasks();
  find_periods();
  starts_ = is_start_of_steps();
}

/// Finds the tasks on demand that write what a task reads.
void Scheduler::find_providers() {
  std::unordered_map<std::uint32_t, std::vector<TaskId>> writers;
  for (TaskId t = 0; t < tasks_.size(); ++t)
    if (tasks_[t].rate.on_demand())
      for (const std::uint32_t slot : tasks_[t].writes) {
        auto& list = writers[slot];
        if (list.empty() || list.back() != t) list.push_back(t);
      }
  providers_.assign(tasks_.size(), {});
  for (TaskId t = 0; t < tasks_.size(); ++t) {
    for (const std::uint32_t slot : tasks_[t].reads)
      if (const auto found = writers.find(slot); found != writers.end())
        for (const TaskId w : found->second)
          if (w != t && !(tasks_[w].part() == InstantPart::switches && tasks_[t].order() < tasks_[w].order()))
            providers_[t].push_back(w);  // who runs before levels sees those of the last step
    auto& p = providers_[t];
    std::sort(p.begin(), p.end());
    p.erase(std::unique(p.begin(), p.end()), p.end());
    std::stable_sort(p.begin(), p.end(), [&](TaskId a, TaskId b) { return tasks_[a].order() < tasks_[b].order(); });
  }
}

/// Tasks on demand of InstantPart::forces belong to the steps of the motions that read what they write.
void Scheduler::find_step_tasks() {
  belongs_to_steps_.assign(tasks_.size(), false);
  std::vector<TaskId> asking;
  for (TaskId t = 0; t < tasks_.size(); ++t)
    if (tasks_[t].part() == InstantPart::moves && !tasks_[t].rate.on_demand()) asking.push_back(t);
  while (!asking.empty()) {
    const TaskId reader = asking.back();
    asking.pop_back();
    for (const TaskId p : providers_[reader]) {
      if (belongs_to_steps_[p] || tasks_[p].part() != InstantPart::forces) continue;
      belongs_to_steps_[p] = true;
      asking.push_back(p);
    }
  }
}

/// Not where levels may change in this very instant, before contact.
bool Scheduler::is_start_of_steps() const {
  bool has_first_run = false;
  for (TaskId t = 0; t < tasks_.size(); ++t) has_first_run = has_first_run || (belongs_to_steps_[t] && runs_[t] == 0);
  return has_first_run &&
         std::none_of(tasks_.begin(), tasks_.end(), [](const Task& t) { return t.part() == InstantPart::switches; });
}

/// A task on demand has the longest period of those that ask for it, in every instant, so that its results do not
/// depend on who else happens to be due. Of the tasks that belong to the steps of motions only motions ask; of others
/// those that do more than look, where there are some.
void Scheduler::find_periods() {
  periods_.assign(tasks_.size(), 0);
  for (TaskId t = 0; t < tasks_.size(); ++t)
    if (!tasks_[t].rate.on_demand()) periods_[t] = tasks_[t].rate.period();
  const auto periods_by = [&](const auto& asks) {
    std::vector<bool> counts(tasks_.size());
    for (TaskId t = 0; t < tasks_.size(); ++t) counts[t] = asks(tasks_[t]);
    return periods_of_asked(counts);
  };
  const std::vector<double> of_motions = periods_by([](const Task&t) { return t.part() == InstantPart::moves; }),
                            of_writers = periods_by([](const Task&t) { return !observes(t); }),
                            of_all = periods_by([](const Task&) { return true; });
  for (TaskId t = 0; t < tasks_.size(); ++t)
    if (tasks_[t].rate.on_demand())
      periods_[t] = belongs_to_steps_[t] ? of_motions[t] : of_writers[t] > 0 ? of_writers[t] : of_all[t];
}

/// Returns for each task on demand the longest period of the tasks with a rate that `count` and ask for it, themselves
/// or through other tasks on demand.
std::vector<double> Scheduler::periods_of_asked(const std::vector<bool>& counts) const {
  std::vector<double> periods(tasks_.size());
  for (TaskId t = 0; t < tasks_.size(); ++t) {
    if (tasks_[t].rate.on_demand() || !counts[t]) continue;
    std::vector<bool> seen(tasks_.size());
    std::vector<TaskId> asking{t};
    while (!asking.empty()) {
      const TaskId reader = asking.back();
      asking.pop_back();
      for (const TaskId p : providers_[reader]) {
        if (seen[p]) continue;
        seen[p] = true;
        if (tasks_[p].rate.on_demand()) periods[p] = std::max(periods[p], periods_[t]);
        if (counts[p] || belongs_to_steps_[p]) asking.push_back(p);
      }
    }
  }
  return periods;
}

void Scheduler::add_providers(TaskId reader, std::vector<bool>& added, std::vector<Task::Due>& due) const {
  const bool is_step = belongs_to_steps_[reader] || tasks_[reader].part() == InstantPart::moves;
  for (const TaskId p : providers_[reader]) {
    if (added[p] || (belongs_to_steps_[p] && !is_step)) continue;
    added[p] = true;
    add_providers(p, added, due);
    due.push_back({p, periods_[p]});
  }
}

/// Adds the tasks that motions among the due items ask for.
void Scheduler::add_step_tasks(const std::vector<std::size_t>& items, std::vector<bool>& added,
                               std::vector<Task::Due>& due) const {
  for (const std::size_t i : items)
    for (const TaskId motion : items_[i]) {
      if (tasks_[motion].part() != InstantPart::moves) continue;
      for (const TaskId p : providers_[motion]) {
        if (!belongs_to_steps_[p] || added[p]) continue;
        added[p] = true;
        add_providers(p, added, due);
        due.push_back({p, periods_[p]});
      }
    }
}

/// `starts`: what belongs to the steps of motions runs before all who might read it.
std::vector<Task::Due> Scheduler::due_tasks_of(const Mask& due, bool starts) const {
  std::vector<std::size_t> items;
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (!items_[i].empty() && !tasks_[items_[i].front()].rate.on_demand() && due[group_of_item_[i]]) items.push_back(i);
  std::stable_sort(items.begin(), items.end(), [&](std::size_t a, std::size_t b) {
    const TaskId first = items_[a].front(), second = items_[b].front();
    if (tasks_[first].order() != tasks_[second].order()) return tasks_[first].order() < tasks_[second].order();
    return first < second;
  });
  std::vector<Task::Due> tasks;
  std::vector<bool> added(tasks_.size());
  const auto add = [&](TaskId t) {
    add_providers(t, added, tasks);
    tasks.push_back({t, periods_[t]});
  };
  for (const std::size_t i : items) {
    if (starts && tasks_[items_[i].front()].part() != InstantPart::completes) {
      add_step_tasks(items, added, tasks);
      starts = false;
    }
    for (const TaskId t : items_[i]) add(t);
  }
  return tasks;
}

Plan Scheduler::plan_of(const std::vector<Task::Due>& due, std::uint32_t instants) const {
  Plan plan;
  for (std::uint32_t i = 0; i < instants; ++i)
    for (Task::Due t : due) {
      t.instant = i;
      plan.due.push_back(t);
    }
  plan.stages = stages_of(plan.due, tasks_, robot_of_slot_, !executor_.is_observed());
  return plan;
}

Scheduler::Plans& Scheduler::plans_for(const Mask& due) {
  if (last_plans_ && due == last_due_) return *last_plans_;
  const auto known = plans_.find(due);
  last_plans_ = known != plans_.end()
                    ? &known->second
                    : &plans_.emplace(due, Plans{plan_of(due_tasks_of(due, false), 1), {}}).first->second;
  last_due_ = due;
  return *last_plans_;
}

std::vector<Task::Due> Scheduler::due_tasks_at(std::int64_t time) const {
  Mask due(groups_.size());
  for (std::size_t g = 0; g < due.size(); ++g) {
    const std::int64_t since = time - groups_[g].phase;
    due[g] = since >= 0 && groups_[g].rate.time_of(groups_[g].rate.first_from(since)) == since;
  }
  return due_tasks_of(due, false);
}

std::vector<TaskId> Scheduler::order_at(std::int64_t time) const {
  std::vector<TaskId> order;
  for (const Task::Due& t : due_tasks_at(time)) order.push_back(t.task);
  return order;
}

std::vector<Stage> Scheduler::stages_at(std::int64_t time) const { return plan_of(due_tasks_at(time), 1).stages; }

std::string Scheduler::set_threads(unsigned threads) {
  forget_plans();
  return executor_.set_threads(threads);
}

void Scheduler::forget_plans() {
  plans_.clear();
  last_plans_ = nullptr;
}

std::int64_t Scheduler::next_time() const {
  std::int64_t next = never;
  for (const Group& g : groups_) next = std::min(next, g.next_time);
  return next;
}

void Scheduler::mark_due(std::int64_t time, Mask& due) const {
  for (std::size_t i = 0; i < groups_.size(); ++i) due[i] = groups_[i].next_time == time;
}

void Scheduler::advance(const Mask& due) {
  for (std::size_t i = 0; i < groups_.size(); ++i)
    if (due[i]) {
      Group& g = groups_[i];
      g.next_time = g.rate.time_of(++g.next_run) + g.phase;
    }
}

/// Takes the present instant, and those behind it in which the same is due, up to as many as are carried out together.
/// Returns how many there are.
std::uint32_t Scheduler::take_instants(std::int64_t end) {
  mark_due(now_, due_);
  std::uint32_t count = 0;
  for (std::int64_t time = now_; count < instants_together && time < end; time = next_time()) {
    mark_due(time, next_due_);
    if (next_due_ != due_) break;
    times_[count++] = time;
    advance(next_due_);
    if (starts_ || one_at_a_time_ || pacer_.is_active()) break;  // in pace, each waits for its own time
  }
  return count;
}

void Scheduler::run_until(std::int64_t end, const std::function<bool()>& stop) {
  if (!prepared_) prepare();
  for (std::int64_t next = next_time(); next < end; next = next_time()) {
    now_ = next;
    if (pacer_.is_active() && pacer_.wait(now_, min_period_, stop)) return;
    const std::uint32_t count = take_instants(end);
    const std::span<const std::int64_t> times(times_.data(), count);
    if (starts_) {
      Plan plan = plan_of(due_tasks_of(due_, true), 1);
      executor_.run(tasks_, plan, times, seed_, runs_);
      starts_ = is_start_of_steps();
    } else if (Plans& plans = plans_for(due_); count == instants_together) {
      if (plans.together.due.empty()) plans.together = plan_of(plans.one.due, instants_together);
      executor_.run(tasks_, plans.together, times, seed_, runs_);
    } else {
      for (std::uint32_t i = 0; i < count; ++i) executor_.run(tasks_, plans.one, times.subspan(i, 1), seed_, runs_);
    }
    now_ = times.back();
    if (stop && stop()) {
      ++now_;  // the instant is complete
      return;
    }
  }
  now_ = std::max(now_, end);
}

void Scheduler::run_extra(const std::vector<TaskId>& tasks) {
  if (!prepared_) prepare();
  std::vector<std::uint64_t> runs = runs_;
  std::vector<Task::Due> due;
  for (const TaskId t : tasks) due.push_back({t, periods_[t]});
  Plan plan = plan_of(due, 1);
  executor_.run(tasks_, plan, {&now_, 1}, seed_, runs);
}

Scheduler::State Scheduler::state() const { return {now_, runs_}; }

void Scheduler::set_state(const State& state) {
  if (state.runs.size() != runs_.size())
    throw SetupError("the snapshot is of another simulation: it has other algorithms");
  now_ = state.now;
  runs_ = state.runs;
  prepared_ = false;
  set_pacing(pacer_.pacing());
}

}  // namespace muro
