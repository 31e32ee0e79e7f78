// SPDX-License-Identifier: MIT
#include "core/schedule/workers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

namespace muro {
namespace {

/// Counts how often each piece was made.
struct Counts {
  std::vector<std::atomic<int>> of_piece;
  std::array<std::atomic<int>, 16> of_thread{};
  explicit Counts(std::size_t pieces) : of_piece(pieces) {}
  static void make(void* self, std::uint32_t piece, unsigned thread) {
    auto& counts = *static_cast<Counts*>(self);
    counts.of_piece[piece].fetch_add(1, std::memory_order_relaxed);
    counts.of_thread[thread].fetch_add(1, std::memory_order_relaxed);
  }
};

TEST(Workers, MakeEachPieceOnce) {
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    Workers workers(threads);
    for (const std::uint32_t pieces : {0u, 1u, 2u, 7u, 100u, 200'000u}) {
      Counts counts(pieces);
      workers.run(pieces, &Counts::make, &counts);
      for (const auto& c : counts.of_piece) ASSERT_EQ(c, 1) << pieces << " pieces on " << threads << " threads";
    }
  }
}

TEST(Workers, BeginWithTheSharesThatTheyAreGiven) {
  Workers workers(3);
  for (int round = 0; round < 1000; ++round) {
    Counts counts(10);
    const std::uint32_t ends[] = {std::uint32_t(round % 4), std::uint32_t(round % 4 + round % 7), 10};
    workers.run(ends, &Counts::make, &counts);
    for (const auto& c : counts.of_piece) ASSERT_EQ(c, 1) << "round " << round;
  }
}

TEST(Workers, ThousandsOfRoundsFollowEachOtherWithoutAMix) {
  Workers workers(4);
  for (int round = 0; round < 20'000; ++round) {
    Counts counts(std::size_t(round % 9));
    workers.run(std::uint32_t(counts.of_piece.size()), &Counts::make, &counts);
    for (const auto& c : counts.of_piece) ASSERT_EQ(c, 1) << "round " << round;
  }
}

TEST(Workers, WakeUpAfterASleep) {
  Workers workers(3);
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // far beyond their patience
    Counts counts(50);
    workers.run(50, &Counts::make, &counts);
    for (const auto& c : counts.of_piece) ASSERT_EQ(c, 1);
  }
}

TEST(Workers, ShareLongWork) {
  struct Long {
    std::array<std::atomic<int>, 4> of_thread{};
    static void make(void* self, std::uint32_t, unsigned thread) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // sleeping threads overlap on any machine
      static_cast<Long*>(self)->of_thread[thread].fetch_add(1);
    }
  } work;
  Workers workers(4);
  workers.run(40, &Long::make, &work);
  for (const auto& made : work.of_thread) EXPECT_GT(made, 0);
}

}  // namespace
}  // namespace muro
