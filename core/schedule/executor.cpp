// SPDX-License-Identifier: MIT
#include "core/schedule/executor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace muro {

namespace {

/// Whether a step is one of those, one in `sampling`, whose costs are measured. Multiples of the golden ratio modulo 1
/// are spread evenly (Weyl), and so are those of each sixteenth step alone, in which an algorithm may do more.
bool is_sampled(std::uint64_t index, std::uint64_t sampling) {
  constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15;  // 2^64 times its fraction
  return index * golden_ratio < ~std::uint64_t(0) / sampling;
}

}  // namespace

std::string Executor::set_threads(unsigned threads) {
  threads_ = std::max(1u, threads);
  workers_.reset();
  std::string why_fewer;
  if (threads_ > 1) {
    workers_ = std::make_unique<WorkerPool>(threads_);
    threads_ = workers_->threads();
    why_fewer = workers_->why_fewer();
    if (threads_ == 1) workers_.reset();
  }
  set_tasks(state_.front().costs.size());
  return why_fewer;
}

void Executor::set_tasks(std::size_t count) {
  state_.resize(std::max<std::size_t>(state_.size(), threads_));
  for (Thread& t : state_) t.costs.resize(count);
  timeline_.set_threads(state_.size());
}

Task::Cost Executor::cost(TaskId task) const {
  Task::Cost all;
  for (const Thread& t : state_) {
    all.runs += t.costs[task].runs;
    all.ticks += t.costs[task].ticks;
  }
  return all;
}

void Executor::run(const std::vector<Task>& tasks, Plan& plan, std::span<const std::int64_t> times, std::uint64_t seed,
                   std::vector<std::uint64_t>& runs) {
  now_ = {tasks.data(), times.data(), runs.data(), seed};
  const bool parallel = workers_ && !observer_ && (always_parallel_ || plan.tuner.parallel());
  const std::uint64_t before = ticks();
  for (const Stage& stage : plan.stages) run_stage(stage, parallel);
  if (workers_ && !always_parallel_) plan.tuner.learn(ticks() - before);
  for (const Task::Due& due : plan.due) {
    ++runs[due.task];
    ++state_.front().costs[due.task].runs;
  }
}

void Executor::run_stage(const Stage& stage, bool parallel) {
  if (!stage.is_enabled()) return;
  if (parallel && stage.chains() > 1)
    workers_->run(stage.chains(), &Executor::run_item, this, &stage);
  else
    for (std::uint32_t c = 0; c < stage.chains(); ++c) run_chain(stage, c, 0);
  throw_first_failure();
}

void Executor::run_item(void* executor, const void* stage, std::uint32_t chain, unsigned thread) {
  static_cast<Executor*>(executor)->run_chain(*static_cast<const Stage*>(stage), chain, thread);
}

void Executor::run_chain(const Stage& stage, std::uint32_t chain, unsigned thread) {
  // To read a clock takes as long as a small step: costs of long runs are those of one step in eight.
  constexpr std::uint64_t all_at_first = 64, sampling = 8;
  Thread& state = state_[thread];
  RunningCall& running = running_call();
  running.function.store("step", std::memory_order_relaxed);
  for (const Stage::Call& call : stage.chain(chain)) {
    if (!call.is_enabled()) continue;
    const Task& task = now_.tasks[call.task];
    const std::int64_t time = now_.times[call.instant];
    const Step step{time, call.dt, now_.runs[call.task] + call.instant, now_.seed, call.phase};
    const bool each = timeline_.on() || step.index < all_at_first, timed = each || is_sampled(step.index, sampling);
    const bool of_items = task.phases[call.phase].index_space == Phase::IndexSpace::items;
    const std::uint64_t before = timed ? ticks() : 0;
    abi::ErrorText error;
    running.enter(task.callee.get(), time, of_items ? call.range : Range{});
    const bool fine =
        observer_ ? observer_->call(task, step, call.range, error) : task.instance->step(step, call.range, error);
    if (timed) {
      const std::uint64_t after = ticks();
      state.costs[call.task].ticks += (after - before) * (each ? 1 : sampling);
      if (timeline_.on()) timeline_.add(thread, {call.task, call.phase, call.range, time, before, after});
    }
    if (fine) continue;
    const std::uint64_t place = std::uint64_t(call.order) << 32 | call.range.begin;
    if (place < state.failure.place)
      state.failure = {place, fmt::format("{} failed at t = {:f} s: {}", who(running, error.view()),
                                          1e-9 * double(time), error.view())};
    break;
  }
  running.leave();
}

void Executor::throw_first_failure() {
  Failure* first = nullptr;
  for (Thread& t : state_)
    if (!t.failure.text.empty() && (!first || t.failure.place < first->place)) first = &t.failure;
  if (!first) return;
  const std::string text = first->text;
  for (Thread& t : state_) t.failure = {};
  throw StepError(text);
}

}  // namespace muro
