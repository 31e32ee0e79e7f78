// SPDX-License-Identifier: MIT
#include "core/schedule/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>

#include "core/c_locale.hpp"

namespace muro {

namespace {

constexpr auto spin_limit = std::chrono::microseconds(150);  // of a worker before it sleeps
constexpr unsigned yield_limit = 1024;                       // spins of the caller before it lets others run
constexpr unsigned clock_interval = 64;  // spins between looks at the clock: one takes as long as a few of them

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

constexpr std::uint64_t packed(std::uint32_t round, std::uint32_t end, std::uint32_t next) {
  return std::uint64_t(round) << 32 | end << 16 | next;
}

}  // namespace

WorkerPool::WorkerPool(unsigned threads) {
  threads_.reserve(threads);
  try {
    for (unsigned t = 1; t < threads; ++t) threads_.emplace_back([this, t] { serve(t); });
  } catch (const std::system_error& e) {  // limits of users, containers and memory
    why_fewer_ = e.code().message();
  }
}

WorkerPool::~WorkerPool() {
  quit_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void WorkerPool::run(std::uint32_t items, Work work, void* owner, const void* batch) {
  for (std::uint32_t first = 0; first < items; first += max_items)
    run_round(first, std::min(max_items, items - first), work, owner, batch);
}

void WorkerPool::run_round(std::uint32_t first, std::uint32_t items, Work work, void* owner, const void* batch) {
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  undone_.store(items, std::memory_order_relaxed);
  queue_.first = first;
  queue_.work = work;
  queue_.owner = owner;
  queue_.batch = batch;
  // The caller has its first item at once, while all of this reaches the others.
  queue_.state.store(packed(round, items, 1), std::memory_order_release);
  round_.store(round);
  if (sleepers_.load() > 0) round_.notify_all();
  work(owner, batch, first, 0);
  const std::uint32_t done = 1 + work_on(round, 0);
  for (unsigned spins = 1; undone_.load(std::memory_order_acquire) > done; ++spins) {
    relax();
    if (spins >= yield_limit && spins % clock_interval == 0) std::this_thread::yield();  // fewer cores than threads?
  }
}

/// Returns how many items it has done.
std::uint32_t WorkerPool::work_on(std::uint32_t round, unsigned thread) {
  std::uint32_t done = 0;
  for (std::uint32_t item; take(round, item); ++done)
    queue_.work(queue_.owner, queue_.batch, queue_.first + item, thread);
  return done;
}

bool WorkerPool::take(std::uint32_t round, std::uint32_t& item) {
  std::uint64_t state = queue_.state.load(std::memory_order_acquire);
  while (std::uint32_t(state >> 32) == round) {
    item = std::uint32_t(state & 0xffff);
    if (item >= std::uint32_t(state >> 16 & 0xffff)) return false;
    if (queue_.state.compare_exchange_weak(state, state + 1, std::memory_order_acq_rel, std::memory_order_acquire))
      return true;
  }
  return false;
}

void WorkerPool::serve(unsigned thread) {
  const CLocale locale;
  for (std::uint32_t seen = 0;;) {
    wait_for_round_after(seen);
    seen = round_.load(std::memory_order_acquire);
    if (quit_.load(std::memory_order_relaxed)) return;
    if (const std::uint32_t done = work_on(seen, thread); done > 0) undone_.fetch_sub(done, std::memory_order_acq_rel);
  }
}

void WorkerPool::wait_for_round_after(std::uint32_t seen) {
  std::chrono::steady_clock::time_point start{};
  for (unsigned spins = 1; round_.load(std::memory_order_acquire) == seen; ++spins) {
    relax();
    if (spins % clock_interval != 0) continue;
    const auto now = std::chrono::steady_clock::now();
    if (start == std::chrono::steady_clock::time_point{}) start = now;
    if (now - start < spin_limit) continue;
    sleepers_.fetch_add(1);
    round_.wait(seen);
    sleepers_.fetch_sub(1);
  }
}

}  // namespace muro
