// SPDX-License-Identifier: MIT
#include "core/schedule/executor.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace muro {

void Executor::set_threads(unsigned threads) {
  threads_ = std::max(1u, threads);
  workers_.reset();
  if (threads_ > 1) workers_ = std::make_unique<Workers>(threads_);
  prepare(state_.front().costs.size());
}

void Executor::prepare(std::size_t tasks) {
  balances_.clear();
  state_.resize(std::max<std::size_t>(state_.size(), threads_));
  for (Thread& t : state_) t.costs.resize(tasks);
  timeline_.set_threads(state_.size());
}

TaskCost Executor::cost(TaskId task) const {
  TaskCost all;
  for (const Thread& t : state_) {
    all.runs += t.costs[task].runs;
    all.ticks += t.costs[task].ticks;
  }
  return all;
}

void Executor::run(const std::vector<Task>& tasks, Program& program, std::span<const std::int64_t> times,
                   std::uint64_t seed, std::vector<std::uint64_t>& runs) {
  now_ = {tasks.data(), times.data(), runs.data(), seed};
  const bool parallel = workers_ && !observer_ && (always_parallel_ || program.trial.parallel());
  if (program.jobs.empty()) add_jobs(program);
  const std::uint64_t before = ticks();
  for (Job& job : program.jobs) run_job(job, parallel);
  if (workers_) improve_balances(program.instants);
  if (workers_ && !always_parallel_) program.trial.learn(ticks() - before);
  for (const Turn& t : program.turns) {
    ++runs[t.task];
    ++state_.front().costs[t.task].runs;
  }
}

/// Stages that have equally many chains share them out alike: most often, a chain is a block of robots.
void Executor::add_jobs(Program& program) {
  constexpr std::uint32_t most = 64;  // chains; where there are more, equal shares are good enough
  program.jobs.reserve(program.stages.size());
  for (const Stage& stage : program.stages) {
    Job& job = program.jobs.emplace_back(Job{this, &stage});
    const std::uint32_t chains = stage.chains();
    if (!workers_ || program.once || chains < 2 || chains > most) continue;
    job.balance = &balances_.try_emplace(chains, chains, threads_).first->second;
    job.number = job.balance->add_stage();
  }
}

void Executor::improve_balances(std::uint32_t instants) {
  constexpr std::uint32_t interval = 128;
  instants_run_ += instants;
  if (instants_run_ < interval) return;
  instants_run_ = 0;
  for (auto& [chains, balance] : balances_) balance.improve();
}

void Executor::run_job(Job& job, bool parallel) {
  const Stage& stage = *job.stage;
  if (!stage.is_wanted()) return;
  if (parallel && job.balance)
    workers_->run(job.balance->ends(), &Executor::run_piece, &job);
  else if (parallel && stage.chains() > 1)
    workers_->run(stage.chains(), &Executor::run_piece, &job);
  else
    for (std::uint32_t c = 0; c < stage.chains(); ++c) run_chain(job, c, 0);
  check();
}

void Executor::run_piece(void* job, std::uint32_t piece, unsigned thread) {
  const Job& now = *static_cast<const Job*>(job);
  now.executor->run_chain(now, now.balance ? now.balance->order()[piece] : piece, thread);
}

void Executor::run_chain(const Job& job, std::uint32_t chain, unsigned thread) {
  // To read a clock takes as long as a small step: costs of long runs are those of each eighth step.
  constexpr std::uint64_t all_at_first = 64, part = 8;
  Thread& state = state_[thread];
  std::uint64_t seen = 0;
  for (const Call& call : job.stage->chain(chain)) {
    if (!call.is_wanted()) continue;
    const Task& task = now_.tasks[call.task];
    const std::int64_t time = now_.times[call.instant];
    const Step step{time, call.dt, now_.runs[call.task] + call.instant, now_.seed, call.phase};
    const bool each = timeline_.on() || step.index < all_at_first, timed = each || step.index % part == 0;
    const std::uint64_t before = timed ? ticks() : 0;
    abi::ErrorText error;
    const bool fine =
        observer_ ? observer_->make(task, step, call.range, error) : task.instance->step(step, call.range, error);
    if (timed) {
      const std::uint64_t after = ticks();
      state.costs[call.task].ticks += (after - before) * (each ? 1 : part);
      seen += after - before;
      if (timeline_.on()) timeline_.add(thread, {call.task, call.phase, call.range, time, before, after});
    }
    const std::uint64_t place = std::uint64_t(call.turn) << 32 | call.range.begin;
    if (!fine && place < state.failure.place)
      state.failure = {place, task.name + " failed at t = " + std::to_string(1e-9 * double(time)) +
                                  " s: " + std::string(error.view())};
    if (!fine) return;
  }
  if (seen > 0 && job.balance) job.balance->add_cost(job.number, chain, seen);
}

void Executor::check() {
  Failure* first = nullptr;
  for (Thread& t : state_)
    if (!t.failure.text.empty() && (!first || t.failure.place < first->place)) first = &t.failure;
  if (!first) return;
  const std::string text = first->text;
  for (Thread& t : state_) t.failure = {};
  throw StepError(text);
}

}  // namespace muro
