// SPDX-License-Identifier: MIT
#include "core/schedule/worker_pool.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace muro {
namespace {

/// Counts how often a thread has worked on each item.
struct Counts {
  std::vector<std::atomic<int>> of_item;
  std::array<std::atomic<int>, 16> of_thread{};
  explicit Counts(std::size_t items) : of_item(items) {}
  static void work(void* self, const void*, std::uint32_t item, unsigned thread) {
    auto& counts = *static_cast<Counts*>(self);
    counts.of_item[item].fetch_add(1, std::memory_order_relaxed);
    counts.of_thread[thread].fetch_add(1, std::memory_order_relaxed);
  }
};

TEST(WorkerPool, WorksOnEachItemOnce) {
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    WorkerPool workers(threads);
    for (const std::uint32_t items : {0u, 1u, 2u, 7u, 100u, 200'000u}) {
      Counts counts(items);
      workers.run(items, &Counts::work, &counts, nullptr);
      for (const auto& c : counts.of_item) ASSERT_EQ(c, 1) << items << " items on " << threads << " threads";
    }
  }
}

TEST(WorkerPool, KeepsThousandsOfRoundsApart) {
  WorkerPool workers(4);
  for (int round = 0; round < 20'000; ++round) {
    Counts counts(std::size_t(round % 9));
    workers.run(std::uint32_t(counts.of_item.size()), &Counts::work, &counts, nullptr);
    for (const auto& c : counts.of_item) ASSERT_EQ(c, 1) << "round " << round;
  }
}

TEST(WorkerPool, WakesSleepingThreads) {
  WorkerPool workers(3);
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // far beyond the spin limit
    Counts counts(50);
    workers.run(50, &Counts::work, &counts, nullptr);
    for (const auto& c : counts.of_item) ASSERT_EQ(c, 1);
  }
}

TEST(WorkerPool, SharesLongWork) {
  struct Long {
    std::array<std::atomic<int>, 4> of_thread{};
    static void work_on(void* self, const void*, std::uint32_t, unsigned thread) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // sleeping threads overlap on any machine
      static_cast<Long*>(self)->of_thread[thread].fetch_add(1);
    }
  } work;
  WorkerPool workers(4);
  workers.run(40, &Long::work_on, &work, nullptr);
  for (const auto& count : work.of_thread) EXPECT_GT(count, 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers need address space of their own

/// Leaves so little address space (bytes) that only a few thread stacks fit into it.
void limit_address_space(std::size_t free_bytes) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlimit limit{pages * std::size_t(sysconf(_SC_PAGESIZE)) + free_bytes, RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
}

TEST(WorkerPool, GoesOnWithFewerThreadsWhereNoMoreCanStart) {
  const auto try_many = [] {
    limit_address_space(100u << 20);
    WorkerPool workers(64);
    Counts counts(1000);
    workers.run(1000, &Counts::work, &counts, nullptr);
    const bool all = std::all_of(counts.of_item.begin(), counts.of_item.end(), [](const auto& c) { return c == 1; });
    std::fprintf(stderr, "%s, %s: %s", workers.threads() > 1 && workers.threads() < 64 ? "some" : "not some",
                 all ? "all done" : "not all done", workers.why_fewer().c_str());
    std::_Exit(0);
  };
  EXPECT_EXIT(try_many(), ::testing::ExitedWithCode(0), "some, all done: Resource temporarily unavailable");
}

#endif

}  // namespace
}  // namespace muro
