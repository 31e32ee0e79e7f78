// SPDX-License-Identifier: MIT
#include "tests/bench/round_trip.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace muro::bench {

double round_trip() {
  constexpr int messages = 100'000;
  struct Mailbox {
    alignas(128) std::atomic<int> there{0};
    alignas(128) std::atomic<int> back{0};
  } mail;
  std::thread other([&] {
    for (int i = 1; i <= messages; ++i) {
      while (mail.there.load(std::memory_order_acquire) != i) continue;
      mail.back.store(i, std::memory_order_release);
    }
  });
  const auto start = std::chrono::steady_clock::now();
  for (int i = 1; i <= messages; ++i) {
    mail.there.store(i, std::memory_order_release);
    while (mail.back.load(std::memory_order_acquire) != i) continue;
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  other.join();
  return 1e9 * passed.count() / messages;
}

}  // namespace muro::bench
