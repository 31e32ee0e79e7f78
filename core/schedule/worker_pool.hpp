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

/// Threads that take numbered work items from one queue, together with the thread that calls.
///
/// Waking a sleeping thread takes some 50 us on a virtual machine, a spinning one below 1 us, so workers spin for a
/// while before they sleep. Nobody waits for a worker that has taken no item: one that the machine has put aside costs
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
  static constexpr std::uint32_t max_items = 0xffff;  ///< in a queue
  struct alignas(cache_distance) Queue {
    /// The round it belongs to, the number of items, the next item; in one word, so that a thread that comes late takes
    /// nothing of another round.
    std::atomic<std::uint64_t> state{0};
    std::uint32_t first = 0;  ///< of the items, in all
    Work work = nullptr;
    void* owner = nullptr;
    const void* batch = nullptr;
  };

  void run_round(std::uint32_t first, std::uint32_t items, Work work, void* owner, const void* batch);
  std::uint32_t work_on(std::uint32_t round, unsigned thread);
  bool take(std::uint32_t round, std::uint32_t& item);
  void serve(unsigned thread);
  void wait_for_round_after(std::uint32_t seen);

  Queue queue_;
  alignas(cache_distance) std::atomic<std::uint32_t> round_{0};   ///< workers wait for the next one
  alignas(cache_distance) std::atomic<std::uint32_t> undone_{0};  ///< items, those that the caller has done among them
  alignas(cache_distance) std::atomic<std::uint32_t> sleepers_{0};
  std::atomic<bool> quit_{false};
  std::vector<std::thread> threads_;
  std::string why_fewer_;
};

}  // namespace muro
