// SPDX-License-Identifier: MIT
// Notes about the running call of an algorithm, for messages when it fails, crashes or does not return.
#pragma once

#include <atomic>

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// The item and the library that one thread serves within a call of an algorithm. A set is a plain store, so a step
/// does it for each item. The host clears the note before each call.
struct CallNote {
  static constexpr std::uint32_t no_item = ~std::uint32_t(0);

  std::atomic<std::uint32_t> item{no_item};    ///< place in Connector::items()
  std::atomic<const char*> library{nullptr};   ///< path of a foreign library that runs now; null: the plugin itself
  std::atomic<const char*> function{nullptr};  ///< of that library: "step"

  void set_item(std::uint32_t i) { item.store(i, std::memory_order_relaxed); }
  /// The texts stay valid as long as the algorithm.
  void set_library(const char* path, const char* its_function) {
    function.store(its_function, std::memory_order_relaxed);
    library.store(path, std::memory_order_relaxed);
  }
};

/// An extension of hosts, version 1.
class CallNotes {
 public:
  /// Returns the note of the calling thread, valid as long as this thread. [any thread]
  virtual CallNote& of_this_thread() noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static CallNotes* of(Host& host) { return static_cast<CallNotes*>(host.find_extension(id())); }

 protected:
  ~CallNotes() = default;
};

inline ExtensionId CallNotes::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(CallNote), MURO_PLACE(CallNote, item),
                                           MURO_PLACE(CallNote, library), MURO_PLACE(CallNote, function)};
  return {"muro.CallNotes", 1, abi::extension_layout<CallNotes>(structs, &CallNotes::of_this_thread)};
}

}  // namespace muro
