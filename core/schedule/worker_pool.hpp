// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace muro {

/// Bytes between what several threads write: two lines of the cache, for processors like to fetch them in pairs.
inline constexpr std::size_t cache_distance = 128;

/// Threads that share out numbered work items with the thread that calls.
///
/// Waking a sleeping thread takes some 50 us on a virtual machine, a spinning one below 1 us, so workers spin for a
/// while before they sleep. Each thread begins with a share of its own, the same items from one run to the next, so
/// that it finds their data in its cache; who is done takes the last items of others, but only after a while in which
/// these may get to them. Nobody waits for a worker that has taken no item: one that the machine has put aside costs
/// nothing.
class WorkerPool {
 public:
  /// `threads` with the caller; 1 or more. There are fewer when the machine starts no more.
  explicit WorkerPool(unsigned threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  unsigned threads() const { return unsigned(threads_.size()) + 1; }
  /// Why there are fewer threads than were asked for; empty when there are as many.
  const std::string& why_fewer() const { return why_fewer_; }

  /// Calls work(owner, batch, item, thread) for every item below `items`, each once, on any thread, the caller's being
  /// number 0; returns when all are done. `work` does not throw.
  using Work = void (*)(void* owner, const void* batch, std::uint32_t item, unsigned thread);
  void run(std::uint32_t items, Work work, void* owner, const void* batch);

 private:
  static constexpr std::uint32_t max_items = 0xffff;  ///< in a round
  /// Share of one thread, in one line of the cache: everything that the thread has to fetch before it begins.
  struct alignas(cache_distance) Share {
    /// The round that it belongs to, the end of the items that are left, the next item; in one word, so that a thread
    /// that comes late takes nothing of another round.
    std::atomic<std::uint64_t> state{0};
    std::uint32_t first = 0;  ///< of the items of the round, in all
    Work work = nullptr;
    void* owner = nullptr;
    const void* batch = nullptr;

    std::uint32_t round() const { return std::uint32_t(state.load(std::memory_order_acquire) >> 32); }
  };

  void run_round(std::uint32_t first, std::uint32_t items, Work work, void* owner, const void* batch);
  std::uint32_t work_on(std::uint32_t round, unsigned thread, std::uint64_t begin);
  std::uint32_t take_from_others(std::uint32_t round, unsigned thread, std::uint64_t patience);
  static bool take(Share& share, std::uint32_t round, bool last, std::uint32_t& item);
  static bool has_items(const Share& share, std::uint32_t round);
  void serve(unsigned thread);
  void wait_for_round_after(std::uint32_t seen, unsigned thread);

  std::vector<Share> shares_;                                     ///< one a thread
  alignas(cache_distance) std::atomic<std::uint32_t> round_{0};   ///< sleepers wait for the next one
  alignas(cache_distance) std::atomic<std::uint32_t> undone_{0};  ///< items, those that the caller has done among them
  alignas(cache_distance) std::atomic<std::uint32_t> sleepers_{0};
  std::atomic<bool> quit_{false};
  std::vector<std::thread> threads_;
  std::string why_fewer_;
};

}  // namespace muro
