// SPDX-License-Identifier: MIT
#include "core/workers.hpp"

#include <sched.h>

#include <algorithm>
#include <chrono>

namespace muro {

namespace {

constexpr auto patience = std::chrono::microseconds(150);  // of a worker before it sleeps
constexpr auto courtesy = std::chrono::microseconds(20);   // before work of another thread is taken

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// The calling thread goes on elsewhere, where there is another processor for it.
void leave_processor(int number) {
  cpu_set_t allowed, others;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  others = allowed;
  CPU_CLR(std::size_t(number), &others);
  if (CPU_COUNT(&others) == 0 || sched_setaffinity(0, sizeof others, &others) != 0) return;
  sched_setaffinity(0, sizeof allowed, &allowed);
}

constexpr std::uint64_t packed(std::uint32_t round, std::uint32_t end, std::uint32_t next) {
  return std::uint64_t(round) << 32 | end << 16 | next;
}

}  // namespace

Workers::Workers(unsigned threads) : shares_(std::max(1u, threads)) {
  for (unsigned t = 1; t < shares_.size(); ++t) threads_.emplace_back([this, t] { serve(t); });
}

Workers::~Workers() {
  quit_.store(true, std::memory_order_relaxed);
  const std::uint32_t last = round_.load(std::memory_order_relaxed) + 1;
  for (Share& s : shares_) s.left.store(packed(last, 0, 0), std::memory_order_release);
  round_.store(last);
  round_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Workers::run(std::uint32_t pieces, Work work, void* context) {
  const auto count = std::uint64_t(shares_.size());
  for (std::uint32_t first = 0; first < pieces; first += most) {
    const std::uint32_t now = std::min(most, pieces - first);
    round({first, now, work, context}, [&](std::size_t t) { return std::uint32_t((t + 1) * now / count); });
  }
}

void Workers::run(std::span<const std::uint32_t> ends, Work work, void* context) {
  round({0, ends.back(), work, context}, [&](std::size_t t) { return ends[t]; });
}

template <typename EndOf>
void Workers::round(const Round& round, EndOf end_of) {
  const std::uint32_t number = round_.load(std::memory_order_relaxed) + 1;
  undone_.store(round.pieces, std::memory_order_relaxed);
  // This thread's own share comes last, when the others are at work.
  for (std::size_t t = shares_.size(); t-- > 0;) {
    Share& share = shares_[t];
    share.work = round.work;
    share.context = round.context;
    share.first = round.first;
    share.left.store(packed(number, end_of(t), t == 0 ? 0 : end_of(t - 1)), std::memory_order_release);
  }
  round_.store(number);  // sequentially consistent with the count of sleepers
  if (sleepers_.load() > 0) {
    caller_processor_.store(sched_getcpu(), std::memory_order_relaxed);
    round_.notify_all();
  }
  const std::uint32_t done = work_through(number, 0);
  for (int spins = 0; undone_.load(std::memory_order_acquire) > done; ++spins)
    if (spins < 2000)
      relax();
    else
      std::this_thread::yield();  // there may be fewer cores than threads
}

/// Returns how many pieces it did.
std::uint32_t Workers::work_through(std::uint32_t round, unsigned self) {
  std::uint32_t done = empty(shares_[self], round, self);
  if (shares_.size() == 1 || !others_are_late(round)) return done;
  for (std::size_t k = 1; k < shares_.size(); ++k) done += empty(shares_[(self + k) % shares_.size()], round, self);
  return done;
}

std::uint32_t Workers::empty(Share& share, std::uint32_t round, unsigned self) {
  std::uint32_t done = 0;
  for (std::uint32_t piece; take(share, round, piece); ++done) share.work(share.context, share.first + piece, self);
  if (done > 0 && self != 0) undone_.fetch_sub(done, std::memory_order_acq_rel);
  return done;
}

/// Whether pieces are left for so long that their threads must be held up. Fetching the data of a piece from the cache
/// of another core often takes longer than working on it.
bool Workers::others_are_late(std::uint32_t round) const {
  const auto any_left = [&] {
    for (const Share& s : shares_) {
      const std::uint64_t left = s.left.load(std::memory_order_relaxed);
      if (std::uint32_t(left >> 32) == round && (left & 0xffff) < (left >> 16 & 0xffff)) return true;
    }
    return false;
  };
  const auto since = std::chrono::steady_clock::now();
  while (any_left()) {
    for (int i = 0; i < 16; ++i) relax();
    if (std::chrono::steady_clock::now() - since > courtesy) return true;
  }
  return false;
}

bool Workers::take(Share& share, std::uint32_t round, std::uint32_t& piece) {
  std::uint64_t left = share.left.load(std::memory_order_acquire);
  while (std::uint32_t(left >> 32) == round) {
    piece = std::uint32_t(left & 0xffff);
    if (piece >= std::uint32_t(left >> 16 & 0xffff)) return false;
    if (share.left.compare_exchange_weak(left, left + 1, std::memory_order_acq_rel, std::memory_order_acquire))
      return true;
  }
  return false;
}

void Workers::serve(unsigned self) {
  std::uint32_t seen = 0;
  while (true) {
    const auto since = std::chrono::steady_clock::now();
    for (int spins = 1; shares_[self].round() == seen; ++spins) {
      relax();
      if (spins % 64 != 0 || std::chrono::steady_clock::now() - since < patience) continue;
      sleepers_.fetch_add(1);
      round_.wait(seen);  // its store follows those of the shares
      sleepers_.fetch_sub(1);
      // The system likes to wake a thread where the one is that woke it, and takes long to part them.
      const int here = sched_getcpu();
      if (here == caller_processor_.load(std::memory_order_relaxed)) leave_processor(here);
    }
    seen = shares_[self].round();
    if (quit_.load(std::memory_order_relaxed)) return;
    work_through(seen, self);
  }
}

}  // namespace muro
