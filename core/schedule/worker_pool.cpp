// SPDX-License-Identifier: MIT
#include "core/schedule/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>

#include "core/c_locale.hpp"
#include "core/tick_clock.hpp"

namespace muro {

namespace {

constexpr auto spin_limit = std::chrono::microseconds(150);  // of a worker before it sleeps
constexpr unsigned yield_limit = 1024;                       // spins of the caller before it lets others run
constexpr std::uint64_t patience_part = 4;                   // of the time that a share took: before others are helped
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

WorkerPool::WorkerPool(unsigned threads) : shares_(std::max(1u, threads)) {
  threads_.reserve(threads);
  try {
    for (unsigned t = 1; t < threads; ++t) threads_.emplace_back([this, t] { serve(t); });
  } catch (const std::system_error& e) {  // limits of users, containers and memory
    why_fewer_ = e.code().message();
  }
}

WorkerPool::~WorkerPool() {
  quit_.store(true, std::memory_order_relaxed);
  const std::uint32_t last = round_.load(std::memory_order_relaxed) + 1;
  for (Share& s : shares_) s.state.store(packed(last, 0, 0), std::memory_order_release);
  round_.store(last);
  round_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void WorkerPool::run(std::uint32_t items, Work work, void* owner, const void* batch) {
  for (std::uint32_t first = 0; first < items; first += max_items)
    run_round(first, std::min(max_items, items - first), work, owner, batch);
}

void WorkerPool::run_round(std::uint32_t first, std::uint32_t items, Work work, void* owner, const void* batch) {
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1, count = threads();
  undone_.store(items, std::memory_order_relaxed);
  const auto begin_of = [&](std::uint32_t t) { return std::uint32_t((std::uint64_t(t) * items + count - 1) / count); };
  for (std::uint32_t t = count; t-- > 0;) {
    Share& share = shares_[t];
    share.first = first;
    share.work = work;
    share.owner = owner;
    share.batch = batch;
    // The caller has its first item at once, while all of this reaches the others.
    share.state.store(packed(round, begin_of(t + 1), t == 0 ? 1 : begin_of(t)), std::memory_order_release);
  }
  round_.store(round);
  if (sleepers_.load() > 0) round_.notify_all();
  const std::uint64_t begin = ticks();
  work(owner, batch, first, 0);
  const std::uint32_t done = 1 + work_on(round, 0, begin);
  for (unsigned spins = 1; undone_.load(std::memory_order_acquire) > done; ++spins) {
    relax();
    if (spins >= yield_limit && spins % clock_interval == 0) std::this_thread::yield();  // fewer cores than threads?
  }
}

/// Its own share, then the last items of others. `begin`: ticks, when it began. Returns how many items it has done.
std::uint32_t WorkerPool::work_on(std::uint32_t round, unsigned thread, std::uint64_t begin) {
  Share& own = shares_[thread];
  std::uint32_t done = 0;
  for (std::uint32_t item; take(own, round, false, item); ++done)
    own.work(own.owner, own.batch, own.first + item, thread);
  return done + take_from_others(round, thread, (ticks() - begin) / patience_part);
}

/// `patience`: ticks. What another thread has in its cache takes longer here, and again when it comes back.
std::uint32_t WorkerPool::take_from_others(std::uint32_t round, unsigned thread, std::uint64_t patience) {
  const std::uint64_t start = ticks();
  const unsigned count = threads();
  std::uint32_t done = 0;
  for (unsigned k = 1; k < count; ++k) {
    Share& other = shares_[(thread + k) % count];
    while (has_items(other, round) && ticks() - start < patience) relax();
    for (std::uint32_t item; take(other, round, true, item); ++done)
      other.work(other.owner, other.batch, other.first + item, thread);
  }
  return done;
}

bool WorkerPool::has_items(const Share& share, std::uint32_t round) {
  const std::uint64_t state = share.state.load(std::memory_order_acquire);
  return std::uint32_t(state >> 32) == round && (state & 0xffff) < (state >> 16 & 0xffff);
}

/// Takes the last or the next one of the remaining items.
bool WorkerPool::take(Share& share, std::uint32_t round, bool last, std::uint32_t& item) {
  std::uint64_t state = share.state.load(std::memory_order_acquire);
  while (std::uint32_t(state >> 32) == round) {
    const auto next = std::uint32_t(state & 0xffff), end = std::uint32_t(state >> 16 & 0xffff);
    if (next >= end) return false;
    item = last ? end - 1 : next;
    const std::uint64_t rest = packed(round, last ? end - 1 : end, last ? next : next + 1);
    if (share.state.compare_exchange_weak(state, rest, std::memory_order_acq_rel, std::memory_order_acquire))
      return true;
  }
  return false;
}

void WorkerPool::serve(unsigned thread) {
  const CLocale locale;
  for (std::uint32_t seen = 0;;) {
    wait_for_round_after(seen, thread);
    seen = shares_[thread].round();
    if (quit_.load(std::memory_order_relaxed)) return;
    if (const std::uint32_t done = work_on(seen, thread, ticks()); done > 0)
      undone_.fetch_sub(done, std::memory_order_acq_rel);
  }
}

void WorkerPool::wait_for_round_after(std::uint32_t seen, unsigned thread) {
  std::chrono::steady_clock::time_point start{};
  for (unsigned spins = 1; shares_[thread].round() == seen; ++spins) {
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
