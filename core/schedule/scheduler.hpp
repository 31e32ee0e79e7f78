// SPDX-License-Identifier: MIT
// From tasks to threads: an example.
//
// A Task is an algorithm with its items; it has a Rate, or runs on demand. 48 rovers, everything on demand but their
// motion at 1000 Hz. Each millisecond is an instant, for which the Scheduler finds the due tasks in their order: motion
// is due, and before it those on demand whose results it reads:
//
//    kinematics, scene index, collision, contact, motion
//
// Each task has one phase or more: `index_space` says over what a phase runs (its items, all robots, or a whole that is
// not divided), `scope` whether it reads its own robot or all. The robots form blocks, here 0-23 and 24-47, and a phase
// is one call for each block. Stages are made of the calls and what they have access to:
//
//    stage 0   [kinematics 0-23  > index 0-23]      [kinematics 24-47  > index 24-47]     each writes its own robots
//    stage 1   [index, the tree  > collision, new neighbours]                             not divided: one chain
//    stage 2   [collision 0-23   > contact 0-23]    [collision 24-47   > contact 24-47]
//    stage 3   [contact, pairs that meet]
//    stage 4-7 [contact 0-23]                       [contact 24-47]                       disabled while nobody meets
//    stage 8   [motion 0-23]                        [motion 24-47]                        reads the results of contact
//
// [ ] is a call chain: its calls run one after the other. The chains of a stage are the work items of the WorkerPool:
//
//    thread 0   chain 0 of stage 0 | stage 1 | chain 0 of stage 2 | stage 3 | chain 1 of stage 8
//    thread 1   chain 1 of stage 0 |         | chain 1 of stage 2 |         | chain 0 of stage 8
//
// A thread that is free takes the next chain, and a stage begins when the one before is done. The Executor carries this
// out, and the Timeline records who did what. The stages of an instant are a Plan, made once for each set of due tasks;
// for eight instants in which the same is due there is one plan, in which motion of one instant and kinematics of the
// next form one chain. A Plan::Tuner measures now and then whether several threads are faster for a plan than one;
// where they are not, thread 0 does it all. Order and blocks depend on the scene alone, so results never depend on
// threads.
#pragma once

#include <functional>
#include <unordered_map>

#include "core/hash.hpp"
#include "core/pacer.hpp"
#include "core/schedule/executor.hpp"

namespace muro {

/// Runs algorithms at their own rates in integer time.
///
/// Simulated time jumps from instant to instant, an instant being any nanosecond in which something is
/// due. Within an instant the order is fixed: rising `order`, then the order of adding. A sequence
/// takes one place in that order and runs its tasks one after the other. A task on demand runs once an
/// instant, just before the first due task that reads what it writes. Nothing else decides about results:
/// calls that may overlap (see stage.hpp) run on several threads, and the same input gives the same bits.
class Scheduler {
 public:
  TaskId add(Task task);
  /// Tasks that run in this order as one item. All that have a rate have the same rate and phase; those on demand take
  /// it over. Throws SetupError when rates differ or there is none.
  void add_sequence(const std::vector<TaskId>& tasks);

  /// To be called when all tasks have been added.
  void prepare();

  /// Runs everything that is due before `end` (ns). `stop` is asked every few instants, in between them.
  /// Throws StepError; the instant is then incomplete.
  void run_until(std::int64_t end, const std::function<bool()>& stop = {});

  std::int64_t now() const { return now_; }
  void set_seed(std::uint64_t seed) { seed_ = seed; }
  /// A hash in which the seed counts as well.
  std::uint64_t seeded(std::uint64_t hash) const { return hash_bytes(&seed_, sizeof seed_, hash); }
  /// Sets the number of threads; 1: the calling thread alone. Returns why there are fewer, or "". [between runs]
  std::string set_threads(unsigned threads);
  void set_pacing(Pacing pacing) { pacer_.begin(pacing, now_); }
  const Pacer& pacer() const { return pacer_; }
  /// Each instant is complete before the next one begins, so that something can happen in between. [between runs]
  void set_one_at_a_time() { one_at_a_time_ = true; }
  const std::vector<Task>& tasks() const { return tasks_; }
  Task::Cost cost(TaskId t) const { return executor_.cost(t); }
  /// Wall-clock seconds per tick of the costs.
  double seconds_per_tick() const { return executor_.seconds_per_tick(); }
  Executor& executor() { return executor_; }
  const Executor& executor() const { return executor_; }
  /// The robot that each slot of the property store belongs to.
  void set_slots(std::vector<RobotId> robot_of_slot) { robot_of_slot_ = std::move(robot_of_slot); }
  /// How the instant at `time` is divided.
  std::vector<Stage> stages_at(std::int64_t time) const;
  /// Runs these tasks now, outside of the schedule; their run counts stay.
  void run_extra(const std::vector<TaskId>& tasks);
  /// The tasks of the instant at `time` in the order in which they run.
  std::vector<TaskId> order_at(std::int64_t time) const;

  /// Time and run counts, as part of a snapshot.
  struct State {
    std::int64_t now = 0;
    std::vector<std::uint64_t> runs;
  };
  State state() const;
  void set_state(const State& state);

 private:
  /// So many instants with equal work make one plan: motion of one instant and kinematics of the next go block by
  /// block, without waiting for all blocks in between.
  static constexpr std::uint32_t instants_together = 8;
  struct Group {  ///< items of equal rate and phase
    Rate rate;
    std::int64_t phase = 0;
    std::uint64_t next_run = 0;
    std::int64_t next_time = 0;
  };
  using Mask = std::vector<bool>;  ///< which groups are due

  std::vector<Task::Due> due_tasks_of(const Mask& due, bool starts) const;
  std::vector<Task::Due> due_tasks_at(std::int64_t time) const;
  void find_providers();
  void find_step_tasks();
  bool is_start_of_steps() const;
  void find_periods();
  std::vector<double> periods_of_asked(const std::vector<bool>& counts) const;
  void add_step_tasks(const std::vector<std::size_t>& items, std::vector<bool>& added,
                      std::vector<Task::Due>& due) const;
  void add_providers(TaskId reader, std::vector<bool>& added, std::vector<Task::Due>& due) const;
  /// For instants in which the same is due: for one, and for `instants_together` that follow each other.
  struct Plans {
    Plan one, together;
  };
  Plan plan_of(const std::vector<Task::Due>& due, std::uint32_t instants) const;
  Plans& plans_for(const Mask& due);
  void forget_plans();
  std::int64_t next_time() const;
  void mark_due(std::int64_t time, Mask& due) const;
  void advance(const Mask& due);
  std::uint32_t take_instants(std::int64_t end);

  std::vector<Task> tasks_;
  std::vector<RobotId> robot_of_slot_;
  Executor executor_;
  std::vector<std::uint64_t> runs_;
  std::vector<std::vector<TaskId>> items_;  ///< single tasks and sequences, as added
  std::vector<std::int32_t> item_of_;
  bool prepared_ = false;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_item_;
  std::vector<std::vector<TaskId>> providers_;  ///< per task: tasks on demand that write what it reads
  /// Tasks on demand of InstantPart::forces that motions ask for. They run only for motions: a reader in between, or
  /// earlier in the instant, sees the results of the last step, and does not change them.
  std::vector<bool> belongs_to_steps_;
  bool starts_ = false;          ///< in the next instant one of them has its first run
  std::vector<double> periods_;  ///< s, per task; on demand: the longest of those that ask, see find_periods
  Mask due_, next_due_, last_due_;
  Plans* last_plans_ = nullptr;
  std::unordered_map<Mask, Plans> plans_;
  std::array<std::int64_t, instants_together> times_{};  ///< ns, of the instants that are carried out together

  std::int64_t now_ = 0;
  std::uint64_t seed_ = 1;
  Pacer pacer_;
  bool one_at_a_time_ = false;
  std::int64_t min_period_ = 0;  ///< ns
};

}  // namespace muro
