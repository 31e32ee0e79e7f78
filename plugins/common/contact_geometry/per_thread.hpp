// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace muro::contact_geometry {

/// Returns a number of the calling thread that no other thread has ever had.
inline std::uint64_t thread_number() {
  static std::atomic<std::uint64_t> next{0};
  thread_local const std::uint64_t number = next.fetch_add(1, std::memory_order_relaxed);
  return number;
}

/// One object for each thread that asks, made at its first call. Takes no locks. The owner frees all objects.
template <class T>
class PerThread {
 public:
  PerThread() = default;
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;
  ~PerThread() { clear(); }

  /// Returns the object of the calling thread. `make()` returns a std::unique_ptr<T>. [any thread]
  template <class Make>
  T& local(Make make) {
    const std::uint64_t thread = thread_number();
    for (Node* n = first_.load(std::memory_order_acquire); n; n = n->next)
      if (n->thread == thread) return *n->object;
    auto node = std::make_unique<Node>(Node{thread, make(), first_.load(std::memory_order_relaxed)});
    T& object = *node->object;
    while (!first_.compare_exchange_weak(node->next, node.get(), std::memory_order_release, std::memory_order_relaxed))
      ;
    static_cast<void>(node.release());
    return object;
  }

  /// Frees all objects. Nobody may use any of them.
  void clear() {
    Node* n = first_.exchange(nullptr);
    while (n) {
      const std::unique_ptr<Node> dead(n);
      n = dead->next;
    }
  }

 private:
  struct Node {
    std::uint64_t thread;
    std::unique_ptr<T> object;
    Node* next;
  };
  std::atomic<Node*> first_{nullptr};
};

}  // namespace muro::contact_geometry
