// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <thread>
#include <vector>

namespace muro {

/// Bytes between what several threads write: two lines of the cache, for processors like to fetch them in pairs.
inline constexpr std::size_t apart = 128;

/// Threads that share out numbered pieces of work with the thread that calls.
///
/// Waking a sleeping thread takes some 50 us on a virtual machine, a spinning one below 1 us, so workers spin for a
/// while before they sleep. Each thread begins with a part of its own, from one round to the next the same, so that it
/// finds its data in its cache; who is done waits a little before it takes from the others. Nobody waits for a worker
/// that has not taken a piece: one that the machine has put aside costs nothing.
class Workers {
 public:
  /// `threads` with the caller; 1 or more.
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  unsigned threads() const { return unsigned(shares_.size()); }

  /// Calls work(context, piece, thread) for every piece below `pieces`, each once, on any thread; returns when all are
  /// done. `work` does not throw.
  using Work = void (*)(void* context, std::uint32_t piece, unsigned thread);
  void run(std::uint32_t pieces, Work work, void* context);
  /// The same with the pieces that each thread begins with, where they end: those of thread 0 first; at most 65535.
  void run(std::span<const std::uint32_t> ends, Work work, void* context);

 private:
  /// A thread's part, in one line of the cache: that is all that a thread has to fetch before it begins.
  struct alignas(apart) Share {
    /// What is left: the round it belongs to, the end, the next piece; in one word, so that a thread that comes late
    /// takes nothing of another round.
    std::atomic<std::uint64_t> left{0};
    Work work = nullptr;
    void* context = nullptr;
    std::uint32_t first = 0;  ///< piece of the round, in all

    std::uint32_t round() const { return std::uint32_t(left.load(std::memory_order_acquire) >> 32); }
  };
  static constexpr std::uint32_t most = 0xffff;  ///< pieces in a round

  struct Round {
    std::uint32_t first, pieces;
    Work work;
    void* context;
  };
  template <typename EndOf>
  void round(const Round& round, EndOf end_of);
  void finish(std::uint32_t round, std::uint32_t done);
  void wake_sleepers();
  std::uint32_t help(std::uint32_t round, unsigned self);
  std::uint32_t empty(Share& share, std::uint32_t round, unsigned self);
  bool take(Share& share, std::uint32_t round, std::uint32_t& piece);
  void serve(unsigned self);
  void wait_for_round_after(std::uint32_t seen, unsigned self);

  std::vector<Share> shares_;
  alignas(apart) std::atomic<std::uint32_t> round_{0};   ///< sleepers wait for it
  alignas(apart) std::atomic<std::uint32_t> undone_{0};  ///< pieces, those that the caller has done among them
  alignas(apart) std::atomic<std::uint32_t> sleepers_{0};
  std::atomic<int> caller_processor_{-1};  ///< of the one that wakes sleepers
  std::atomic<bool> quit_{false};
  std::vector<std::thread> threads_;
};

}  // namespace muro
