// SPDX-License-Identifier: MIT
// Wraps glibc's allocator. Link it into a test program; plugins then use it too.
#include "tests/support/allocation_counter.hpp"

#include <atomic>
#include <cstddef>

namespace {

std::atomic<std::uint64_t> count{0};
constinit thread_local std::uint64_t own_count = 0;

[[maybe_unused]] void add_one() {
  count.fetch_add(1, std::memory_order_relaxed);
  ++own_count;
}

}  // namespace

namespace muro::test {

std::uint64_t allocations() { return count.load(std::memory_order_relaxed); }
std::uint64_t allocations_of_this_thread() { return own_count; }

}  // namespace muro::test

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);

void* malloc(std::size_t size) {
  add_one();
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  add_one();
  return __libc_calloc(n, size);
}
void* realloc(void* old, std::size_t size) {
  add_one();
  return __libc_realloc(old, size);
}
}
#endif
