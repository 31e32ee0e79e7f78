// SPDX-License-Identifier: MIT
#include "core/executor.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace muro {

/// What is being carried out.
struct Executor::Instant {
  Executor& self;
  const std::vector<Task>& tasks;
  std::span<const std::int64_t> times;
  std::uint64_t seed;
  const std::vector<std::uint64_t>& runs;
  const Stage* stage = nullptr;
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
  const bool parallel = workers_ && !observer_ && choose_parallel(program);
  const std::uint64_t before = ticks();
  for (const Stage& stage : program.stages) {
    instant.stage = &stage;
    run_stage(instant, parallel);
  }
  if (workers_ && !always_parallel_) learn(program.trial, ticks() - before);
  for (const Turn& t : program.turns) {
    ++runs[t.task];
    ++state_.front().costs[t.task].runs;
  }
}

void Executor::run_stage(Instant& instant, bool parallel) {
  const Stage& stage = *instant.stage;
  if (!stage.is_wanted()) return;
  if (parallel && stage.chains() > 1)
    workers_->run(stage.chains(), &Executor::run_piece, &instant);
  else
    for (std::uint32_t c = 0; c < stage.chains(); ++c) run_chain(instant, stage, c, 0);
  check();
}

void Executor::run_piece(void* instant, std::uint32_t chain, unsigned thread) {
  const Instant& now = *static_cast<const Instant*>(instant);
  now.self.run_chain(now, *now.stage, chain, thread);
}

void Executor::run_chain(const Instant& instant, const Stage& stage, std::uint32_t chain, unsigned thread) {
  // To read a clock takes as long as a small step: costs of long runs are those of each eighth step.
  constexpr std::uint64_t all_at_first = 64, part = 8;
  Thread& state = state_[thread];
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
      if (timeline_.on()) timeline_.add(thread, {call.task, call.phase, call.range, time, before, after});
    }
    const std::uint64_t place = std::uint64_t(call.turn) << 32 | call.range.begin;
    if (!fine && place < state.failure.place)
      state.failure = {place, task.name + " failed at t = " + std::to_string(1e-9 * double(time)) +
                                  " s: " + std::string(error.view())};
    if (!fine) return;
  }
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

bool Executor::choose_parallel(Program& program) const {
  using State = Program::Trial::State;
  if (always_parallel_) return true;
  const Program::Trial& t = program.trial;
  return t.state == State::settled ? t.parallel : t.state == State::parallel;
}

/// A machine that is busy with other things may put a worker aside in the middle of its work, which a short trial
/// does not see: what several threads gain is watched as long as they run.
void Executor::watch(Program::Trial& t, double passed) {
  constexpr std::uint32_t window = 64;
  t.watched += passed;
  if (t.instants % window != 0) return;
  if (std::exchange(t.watched, 0) <= window * t.serial) return;
  t.parallel = false;
  t.instants = 0;
}

/// Time decides who computes a result, never what it is.
void Executor::learn(Program::Trial& t, std::uint64_t passed) {
  using State = Program::Trial::State;
  constexpr std::uint32_t shortest_pause = 64, longest_pause = 1u << 16;
  constexpr double worth = 0.97;    // of the time on one thread
  constexpr double hopeless = 1.5;  // the same, of a whole trial; one instant counts no more than `hiccup` times
  constexpr double hiccup = 4;
  ++t.instants;
  if (t.state == State::settled) {
    if (t.parallel) watch(t, double(passed));
    if (t.instants < t.pause) return;
    t.state = State::serial;
    t.instants = 0;
    t.watched = 0;
    return;
  }
  constexpr std::uint32_t all = Program::Trial::warm + Program::Trial::counted;
  t.watched += std::min(double(passed), hiccup * t.serial);
  const bool given_up = t.state == State::parallel && t.watched > hopeless * all * t.serial;
  if (t.instants > Program::Trial::warm) t.seen[t.instants - Program::Trial::warm - 1] = double(passed);
  if (t.instants < all && !given_up) return;
  std::nth_element(t.seen.begin(), t.seen.begin() + t.seen.size() / 2, t.seen.end());
  const double median = t.seen[t.seen.size() / 2];
  t.instants = 0;
  t.watched = 0;
  if (t.state == State::serial) {
    t.serial = median;
    t.state = State::parallel;
    return;
  }
  const bool better = !given_up && median < worth * t.serial;
  t.pause = t.known && better == t.parallel ? std::min(4 * t.pause, longest_pause) : shortest_pause;
  t.known = true;
  t.parallel = better;
  t.state = State::settled;
}

}  // namespace muro
