// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/rate.hpp"
#include "muro/abi.hpp"

namespace muro {

/// What the scheduler runs: one instance of an algorithm with its items.
struct Task {
  std::string name;  ///< "rovers.motion"
  abi::AlgorithmInstance* instance = nullptr;
  std::uint32_t items = 0;
  std::vector<Phase> phases = {Phase{}};  ///< one or more
  std::uint32_t robots = 0;               ///< of the scene
  Rate rate;                                 ///< on demand when zero
  std::int64_t phase = 0;                    ///< ns, 0 or more
  int order = 0;                             ///< tasks of one instant run by rising order, then as added
  std::vector<std::uint32_t> reads, writes;  ///< slots of the property store

  /// How many elements phase number `which` works on.
  std::uint32_t length(std::uint32_t which) const {
    return phases[which].over == Phase::Over::robots ? robots : items;
  }
};
using TaskId = std::uint32_t;

/// What a task has cost so far.
struct TaskCost {
  std::uint64_t runs = 0;
  std::uint64_t ticks = 0;  ///< of the cycle counter
};

/// How fast simulated time may pass.
struct Pacing {
  double factor = 0;  ///< simulated seconds per second of wall clock; 0: as fast as possible
};

/// Runs algorithms at their own rates in integer time.
///
/// Simulated time jumps from instant to instant, an instant being any nanosecond in which something is
/// due. Within an instant the order is fixed: rising `order`, then the order of adding. A sequence
/// takes one place in that order and runs its tasks one behind the other. A task on demand runs once an
/// instant, just before the first due task that reads what it writes. Nothing else decides what runs
/// when, so the same input gives the same bits.
class Scheduler {
 public:
  Scheduler();
  TaskId add(Task task);
  /// Tasks that run in this order as one item. All that have a rate have the same rate and phase; those on demand take
  /// it over. Throws SetupError when rates differ or there is none.
  void add_sequence(const std::vector<TaskId>& tasks);

  /// Runs everything that is due before `end` (ns). `stop` is asked after every instant.
  /// Throws StepError; the instant is then incomplete.
  void run_until(std::int64_t end, const std::function<bool()>& stop = {});

  std::int64_t now() const { return now_; }
  void set_seed(std::uint64_t seed) { seed_ = seed; }
  void set_pacing(Pacing pacing);
  std::uint64_t overruns() const { return overruns_; }
  const std::vector<Task>& tasks() const { return tasks_; }
  const TaskCost& cost(TaskId t) const { return costs_[t]; }
  /// Wall-clock seconds per tick of the costs.
  double seconds_per_tick() const;
  /// Runs these tasks now, outside of the schedule; their run counts stay.
  void run_extra(const std::vector<TaskId>& tasks);
  /// The tasks of the instant at `time` in the order in which they run.
  std::vector<TaskId> plan_at(std::int64_t time) const;

  /// Time and run counts, as part of a snapshot.
  struct State {
    std::int64_t now = 0;
    std::vector<std::uint64_t> runs;
  };
  State state() const;
  void set_state(const State& state);

 private:
  struct Group {  ///< items of equal rate and phase
    Rate rate;
    std::int64_t phase = 0;
    std::uint64_t next_run = 0;
    std::int64_t next_time = 0;
  };
  struct Entry {
    TaskId task;
    double dt;
  };
  using Mask = std::vector<bool>;
  using Plan = std::vector<Entry>;

  void prepare();
  Plan make_plan(const Mask& due) const;
  void find_providers();
  void find_periods();
  void demand(TaskId reader, std::vector<bool>& done, Plan& plan) const;
  const Plan& plan_for(const Mask& due);
  void run_instant(const Plan& plan);
  bool pace(const std::function<bool()>& stop);

  std::vector<Task> tasks_;
  std::vector<TaskCost> costs_;
  std::vector<std::uint64_t> runs_;
  std::vector<std::vector<TaskId>> items_;  ///< single tasks and sequences, as added
  std::vector<std::int32_t> item_of_;
  bool prepared_ = false;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_item_;
  std::vector<std::vector<TaskId>> providers_;  ///< per task: on-demand tasks it needs
  std::vector<double> periods_;                 ///< s, per task; on demand: the longest of those that ask
  Mask due_, last_due_;
  const Plan* last_plan_ = nullptr;
  std::unordered_map<Mask, Plan> plans_;

  std::int64_t now_ = 0;
  std::uint64_t seed_ = 1;
  Pacing pacing_;
  std::chrono::steady_clock::time_point pace_wall_{};
  std::int64_t pace_time_ = 0;
  std::int64_t finest_period_ = 0;
  std::uint64_t overruns_ = 0;
  std::uint64_t first_tick_;
  std::chrono::steady_clock::time_point first_wall_;
};

}  // namespace muro
