// SPDX-License-Identifier: MIT
#include "core/schedule/workers.hpp"

#include <sched.h>

#include <algorithm>
#include <cassert>
#include <chrono>

namespace muro {

namespace {

constexpr unsigned look = 64;  // at the clock, each so many spins: that takes as long as a few of them

/// Time since it was asked for first.
class Watch {
 public:
  std::chrono::nanoseconds passed() {
    const auto now = std::chrono::steady_clock::now();
    if (start_ == std::chrono::steady_clock::time_point{}) start_ = now;
    return now - start_;
  }

 private:
  std::chrono::steady_clock::time_point start_{};
};

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
    const auto end_of = [&](std::size_t t) { return std::uint32_t(((t + 1) * now + count - 1) / count); };
    round({first, now, work, context}, end_of);  // the caller, number 0, has more than others, where one must
  }
}

void Workers::run(std::span<const std::uint32_t> ends, Work work, void* context) {
  assert(ends.size() == shares_.size() && ends.back() <= most);
  round({0, ends.back(), work, context}, [&](std::size_t t) { return ends[t]; });
}

template <typename EndOf>
void Workers::round(const Round& round, EndOf end_of) {
  const std::uint32_t number = round_.load(std::memory_order_relaxed) + 1;
  undone_.store(round.pieces, std::memory_order_relaxed);
  // The caller has its first piece at once: to take it from its share would mean to wait until all of this has reached
  // the others.
  const std::uint32_t at_once = end_of(0) > 0 ? 1 : 0;
  for (std::size_t t = shares_.size(); t-- > 0;) {
    Share& share = shares_[t];
    share.work = round.work;
    share.context = round.context;
    share.first = round.first;
    share.left.store(packed(number, end_of(t), t == 0 ? at_once : end_of(t - 1)), std::memory_order_release);
  }
  round_.store(number, std::memory_order_release);
  wake_sleepers();  // one that goes to sleep just now may miss it, and is woken later
  if (at_once) round.work(round.context, round.first, 0);
  finish(number, at_once + empty(shares_[0], number, 0));
}

/// Waits for the others; takes what they have not begun, once they must be held up.
void Workers::finish(std::uint32_t round, std::uint32_t done) {
  Watch watch;
  bool helped = false;
  for (unsigned spins = 1; undone_.load(std::memory_order_acquire) > done; ++spins) {
    relax();
    if (spins % look != 0) continue;
    if (helped) {
      std::this_thread::yield();  // there may be fewer cores than threads
    } else if (watch.passed() > courtesy) {
      helped = true;
      wake_sleepers();
      done += help(round, 0);
    }
  }
}

void Workers::wake_sleepers() {
  if (sleepers_.load(std::memory_order_relaxed) == 0) return;
  caller_processor_.store(sched_getcpu(), std::memory_order_relaxed);
  round_.notify_all();
}

/// Makes pieces of the other threads; returns how many.
std::uint32_t Workers::help(std::uint32_t round, unsigned self) {
  std::uint32_t done = 0;
  for (std::size_t k = 1; k < shares_.size(); ++k) done += empty(shares_[(self + k) % shares_.size()], round, self);
  return done;
}

/// Returns how many pieces were left.
std::uint32_t Workers::empty(Share& share, std::uint32_t round, unsigned self) {
  std::uint32_t done = 0;
  for (std::uint32_t piece; take(share, round, piece); ++done) share.work(share.context, share.first + piece, self);
  if (done > 0 && self != 0) undone_.fetch_sub(done, std::memory_order_acq_rel);
  return done;
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
    wait_for_round_after(seen, self);
    seen = shares_[self].round();
    if (quit_.load(std::memory_order_relaxed)) return;
    empty(shares_[self], seen, self);
  }
}

/// Looks at nothing but its own share, for to look at others' takes time from them; after a while at those too.
void Workers::wait_for_round_after(std::uint32_t seen, unsigned self) {
  Watch watch;
  bool helped = seen == 0;
  for (unsigned spins = 1; shares_[self].round() == seen; ++spins) {
    relax();
    if (spins % look != 0) continue;
    const auto waited = watch.passed();
    if (!helped && waited > courtesy) {
      helped = true;
      help(seen, self);
    }
    if (waited < patience) continue;
    sleepers_.fetch_add(1);
    round_.wait(seen);  // its store follows those of the shares
    sleepers_.fetch_sub(1);
    // The system likes to wake a thread where the one is that woke it, and takes long to part them.
    const int here = sched_getcpu();
    if (here == caller_processor_.load(std::memory_order_relaxed)) leave_processor(here);
  }
}

}  // namespace muro
