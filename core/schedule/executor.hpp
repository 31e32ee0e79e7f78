// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "core/schedule/plan.hpp"
#include "core/schedule/worker_pool.hpp"
#include "core/tick_clock.hpp"
#include "core/timeline.hpp"

namespace muro {

/// Makes the calls of a plan, on one or several threads.
class Executor {
 public:
  /// Observes a run whose calls are made one by one; see AccessCheck.
  class Observer {
   public:
    virtual ~Observer() = default;
    /// Makes the call, in its own way. False: it failed, with a text.
    virtual bool call(const Task& task, const Step& step, Range range, abi::ErrorText& error) = 0;
  };

  /// Sets the number of threads; 1: the calling thread alone. Returns why there are fewer, or "". [between runs]
  std::string set_threads(unsigned threads);
  unsigned threads() const { return threads_; }
  /// Takes the place of making calls; null: none. Calls are then made on one thread. [before the first run]
  void set_observer(std::unique_ptr<Observer> observer) { observer_ = std::move(observer); }
  bool is_observed() const { return observer_ != nullptr; }
  /// Whether several threads are used wherever there are several call chains; else only where that is found to be
  /// faster.
  void set_always_parallel(bool always) { always_parallel_ = always; }
  Timeline& timeline() { return timeline_; }
  const Timeline& timeline() const { return timeline_; }

  /// How many tasks there are. [between runs]
  void set_tasks(std::size_t count);
  /// `times`: of each instant, ns. `runs`: how often each task ran before; counted on. Throws StepError, of the failure
  /// that is first in order, when the stage in which it happened is done.
  void run(const std::vector<Task>& tasks, Plan& plan, std::span<const std::int64_t> times, std::uint64_t seed,
           std::vector<std::uint64_t>& runs);

  Task::Cost cost(TaskId task) const;
  double seconds_per_tick() const { return clock_.seconds_per_tick(); }

 private:
  struct Failure {
    std::uint64_t place = ~std::uint64_t(0);  ///< in the order of the instant
    std::string text;
  };
  struct alignas(cache_distance) Thread {
    std::vector<Task::Cost> costs;
    Failure failure;
  };
  /// What is being carried out.
  struct alignas(cache_distance) Instants {
    const Task* tasks;
    const std::int64_t* times;
    const std::uint64_t* runs;
    std::uint64_t seed;
  };

  void run_stage(const Stage& stage, bool parallel);
  void run_chain(const Stage& stage, std::uint32_t chain, unsigned thread);
  static void run_item(void* executor, const void* stage, std::uint32_t chain, unsigned thread);
  void throw_first_failure();

  Instants now_{};
  unsigned threads_ = 1;
  bool always_parallel_ = false;
  std::unique_ptr<WorkerPool> workers_;
  std::unique_ptr<Observer> observer_;
  std::vector<Thread> state_ = std::vector<Thread>(1);
  TickClock clock_;
  Timeline timeline_;
};

}  // namespace muro
