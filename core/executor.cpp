// SPDX-License-Identifier: MIT
#include "core/executor.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace muro {

/// What is being carried out. All threads look at it all the time.
struct alignas(apart) Executor::Instant {
  Executor& self;
  const std::vector<Task>& tasks;
  std::span<const std::int64_t> times;
  std::uint64_t seed;
  const std::vector<std::uint64_t>& runs;
  const Stage* stage = nullptr;
  Program::Sharing sharing = {};
};

void Executor::set_threads(unsigned threads) {
  threads_ = std::max(1u, threads);
  workers_.reset();
  if (threads_ > 1) workers_ = std::make_unique<Workers>(threads_);
  prepare(state_.front().costs.size());
}

void Executor::prepare(std::size_t tasks) {
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
  Instant instant{*this, tasks, times, seed, runs};
  const bool parallel = workers_ && !observer_ && (always_parallel_ || program.trial.parallel());
  if (workers_ && program.sharing.empty()) share_out(program);
  const std::uint64_t before = ticks();
  for (std::size_t s = 0; s < program.stages.size(); ++s) {
    instant.stage = &program.stages[s];
    if (workers_) instant.sharing = program.sharing[s];
    run_stage(instant, parallel);
  }
  if (workers_ && !always_parallel_) program.trial.learn(ticks() - before);
  if (parallel) improve_balances();
  for (const Turn& t : program.turns) {
    ++runs[t.task];
    ++state_.front().costs[t.task].runs;
  }
}

/// Stages that have equally many chains share them out alike: most often, a chain is a block of robots.
void Executor::share_out(Program& program) {
  constexpr std::uint32_t most = 64;  // chains; where there are more, equal shares are good enough
  program.sharing.resize(program.stages.size());
  for (std::size_t s = 0; s < program.stages.size(); ++s) {
    const std::uint32_t chains = program.stages[s].chains();
    if (chains < 2 || chains > most) continue;
    Balance& balance = balances_.try_emplace(chains, chains, threads_).first->second;
    program.sharing[s] = {&balance, balance.add_stage()};
  }
}

void Executor::improve_balances() {
  constexpr std::uint32_t interval = 64;
  if (++programs_run_ < interval) return;
  programs_run_ = 0;
  for (auto& [chains, balance] : balances_) balance.improve();
}

void Executor::run_stage(Instant& instant, bool parallel) {
  const Stage& stage = *instant.stage;
  if (!stage.is_wanted()) return;
  if (parallel && instant.sharing.balance)
    workers_->run(instant.sharing.balance->ends(), &Executor::run_piece, &instant);
  else if (parallel && stage.chains() > 1)
    workers_->run(stage.chains(), &Executor::run_piece, &instant);
  else
    for (std::uint32_t c = 0; c < stage.chains(); ++c) run_chain(instant, stage, c, 0);
  check();
}

void Executor::run_piece(void* instant, std::uint32_t piece, unsigned thread) {
  const Instant& now = *static_cast<const Instant*>(instant);
  const std::uint32_t chain = now.sharing.balance ? now.sharing.balance->order()[piece] : piece;
  now.self.run_chain(now, *now.stage, chain, thread);
}

void Executor::run_chain(const Instant& instant, const Stage& stage, std::uint32_t chain, unsigned thread) {
  // To read a clock takes as long as a small step: costs of long runs are those of each eighth step.
  constexpr std::uint64_t all_at_first = 64, part = 8;
  Thread& state = state_[thread];
  std::uint64_t seen = 0;
  for (const Call& call : stage.chain(chain)) {
    if (!call.is_wanted()) continue;
    const Task& task = instant.tasks[call.task];
    const std::int64_t time = instant.times[call.instant];
    const Step step{time, call.dt, instant.runs[call.task] + call.instant, instant.seed, call.phase};
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
  if (seen > 0 && instant.sharing.balance) instant.sharing.balance->add_cost(instant.sharing.number, chain, seen);
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
