// SPDX-License-Identifier: MIT
// The call of foreign code that each thread is in: for messages about calls that fail, crash or do not return.
#pragma once

#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include "core/signal_text.hpp"
#include "muro/ext/call_note.hpp"
#include "muro/step.hpp"

namespace muro {

/// The called code: an algorithm, a model reader or a library that is being loaded. It does not change during the call.
struct Callee {
  std::string name;         ///< "rovers.motion"
  std::string use{};        ///< "motion.point"
  std::string place{};      ///< "file:line:column" of the scenario
  std::string library{};    ///< path of the plugin
  bool runs_alone = false;  ///< it may take any time
  /// The names of one item.
  struct OfItem {
    bool is_robot = true;
    std::string object;           ///< name of the robot, or of an object that belongs to no robot
    std::string name{}, place{};  ///< those of its subsystem in a world that several share; otherwise empty
  };
  std::vector<OfItem> items{};  ///< empty: the whole scene
};

/// The call that one thread is in. Only this thread writes it, with plain stores; its signal handlers and all other
/// threads may read it at any time.
struct alignas(128) RunningCall {
  static constexpr std::int64_t no_time = std::numeric_limits<std::int64_t>::min();

  std::atomic<const Callee*> callee{nullptr};   ///< null: no call
  std::atomic<const char*> function{""};        ///< "step", "connect"
  std::atomic<std::int64_t> time{no_time};      ///< ns, simulated
  std::atomic<std::uint32_t> begin{0}, end{0};  ///< the items that it serves; empty range: all
  CallNote note;                                ///< the note that the callee sets itself
  std::atomic<std::uint64_t> thread{0};         ///< the system's number of the thread; 0: the thread has ended
  std::atomic<RunningCall*> next{nullptr};      ///< the call of another thread

  void enter(const Callee* called, std::int64_t at, Range items) {
    constexpr auto relaxed = std::memory_order_relaxed;
    note.item.store(CallNote::no_item, relaxed);
    note.library.store(nullptr, relaxed);
    time.store(at, relaxed);
    begin.store(items.begin, relaxed);
    end.store(items.end, relaxed);
    callee.store(called, relaxed);
  }
  void leave() { callee.store(nullptr, std::memory_order_relaxed); }
};

/// Returns the call of the calling thread.
RunningCall& running_call();
/// Returns the call of the calling thread, for signal handlers; null when the thread has made no call yet.
RunningCall* running_call_in_handler() noexcept;
/// Returns the first of the calls of all threads, also of ended ones; `next` leads to the others.
RunningCall* first_running_call() noexcept;
/// Sets a function that each thread calls before its first call from now on; this thread calls it now.
void set_thread_hook(void (*hook)());

/// A call that lasts for the scope of the object; afterwards the call of the outer scope is the current one again.
class CallScope {
 public:
  CallScope(const Callee& callee, const char* function, std::int64_t time = RunningCall::no_time);
  ~CallScope();
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;

 private:
  RunningCall& call_;
  const Callee* const callee_;
  const char* const function_;
  const std::int64_t time_;
  const Range items_;
  const std::uint32_t item_;
  const char* const library_;
};

/// Adds "urban.yaml:14:7: rovers.control (controller.library), robot `rover_3`,". The robots are left out when the
/// message that follows (the last argument) names one of them in backticks. May be called in signal handlers.
void add_who(SignalText& text, const RunningCall& call, std::string_view told = {});
/// Returns the text of add_who. Allocates memory.
std::string who(const RunningCall& call, std::string_view told = {});
/// Adds " in `step` of libcrash.so at t = 1.250000 s". May be called in signal handlers.
void add_where(SignalText& text, const RunningCall& call);

}  // namespace muro
