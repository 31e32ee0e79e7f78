// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/schedule/balance.hpp"
#include "core/schedule/stages.hpp"
#include "core/schedule/ticks.hpp"
#include "core/schedule/timeline.hpp"
#include "core/schedule/trial.hpp"
#include "core/schedule/workers.hpp"

namespace muro {

/// Looks on while calls are made one by one; see AccessCheck.
class CallObserver {
 public:
  virtual ~CallObserver() = default;
  /// Makes the call, in its own way. False: it failed, with a text.
  virtual bool make(const Task& task, const Step& step, Range range, abi::ErrorText& error) = 0;
};

class Executor;

/// How the turns of an instant, or of several in which the same is due, are carried out, and what has been learned
/// about it.
struct Program {
  std::vector<Stage> stages;
  std::vector<Turn> turns;
  std::uint32_t instants = 1;
  bool once = false;  ///< not worth to learn about

  Trial trial;

  /// A stage, as threads are given it. Written once: so it stays in the caches of all.
  struct Job {
    Executor* executor;
    const Stage* stage;
    Balance* balance = nullptr;  ///< who begins with which chains; null: equal shares
    std::uint32_t number = 0;    ///< by which the stage is known there
  };
  std::vector<Job> jobs;  ///< by stage, once the program has run
};

/// Makes the calls of a program, on one or several threads.
class Executor {
 public:
  /// Of calls; 1: the calling thread alone. No program that has run before may run again.
  void set_threads(unsigned threads);
  unsigned threads() const { return threads_; }
  /// Takes the place of making calls; null: none. Calls are then made on one thread. [before the first run]
  void set_observer(std::unique_ptr<CallObserver> observer) { observer_ = std::move(observer); }
  bool observed() const { return observer_ != nullptr; }
  /// Whether several threads are used wherever there are several chains; else only where that is found to be faster.
  void set_always_parallel(bool always) { always_parallel_ = always; }
  Timeline& timeline() { return timeline_; }
  const Timeline& timeline() const { return timeline_; }

  /// Forgets what it has learned of programs, none of which may run again.
  void prepare(std::size_t tasks);
  /// `times`: of each instant, ns. `runs`: how often each task ran before; counted on. Throws StepError, of the failure
  /// that is first in order, when the stage in which it happened is done.
  void run(const std::vector<Task>& tasks, Program& program, std::span<const std::int64_t> times, std::uint64_t seed,
           std::vector<std::uint64_t>& runs);

  TaskCost cost(TaskId task) const;
  double seconds_per_tick() const { return clock_.seconds_per_tick(); }

 private:
  struct Failure {
    std::uint64_t place = ~std::uint64_t(0);  ///< in the order of the instant
    std::string text;
  };
  struct alignas(apart) Thread {
    std::vector<TaskCost> costs;
    Failure failure;
  };
  /// What is being carried out.
  struct alignas(apart) Instants {
    const Task* tasks;
    const std::int64_t* times;
    const std::uint64_t* runs;
    std::uint64_t seed;
  };
  using Job = Program::Job;

  void add_jobs(Program& program);
  void improve_balances(std::uint32_t instants);
  void run_job(Job& job, bool parallel);
  void run_chain(const Job& job, std::uint32_t chain, unsigned thread);
  static void run_piece(void* job, std::uint32_t piece, unsigned thread);
  void check();

  Instants now_{};
  unsigned threads_ = 1;
  bool always_parallel_ = false;
  std::unique_ptr<Workers> workers_;
  std::map<std::uint32_t, Balance> balances_;  ///< by number of chains
  std::uint32_t instants_run_ = 0;             ///< since balances were looked at
  std::unique_ptr<CallObserver> observer_;
  std::vector<Thread> state_ = std::vector<Thread>(1);
  TickClock clock_;
  Timeline timeline_;
};

}  // namespace muro
