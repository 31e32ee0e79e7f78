// SPDX-License-Identifier: MIT
// A data race on purpose: shows that the other runs can fail.
#include <thread>

#include "core/schedule/worker_pool.hpp"

int main() {
  int shared = 0;
  muro::WorkerPool workers(4);
  for (int round = 0; round < 100; ++round)
    workers.run(
        64,
        [](void* at, const void*, std::uint32_t, unsigned) {
          ++*static_cast<int*>(at);
          std::this_thread::yield();
        },
        &shared, nullptr);
  return shared == 0 ? 1 : 0;
}
