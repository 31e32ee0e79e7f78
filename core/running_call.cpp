// SPDX-License-Identifier: MIT
#include "core/running_call.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace muro {

namespace {

/// The calls of all threads.
class CallsOfThreads {
 public:
  static RunningCall* first() { return first_.load(); }
  /// Returns a call that a thread has left behind, or a new one.
  static RunningCall* acquire() {
    const auto number = std::uint64_t(syscall(SYS_gettid));
    for (RunningCall* c = first(); c; c = c->next.load())
      if (std::uint64_t none = 0; c->thread.compare_exchange_strong(none, number)) return c;
    auto* made = new RunningCall;  // never freed: a signal handler may read it at any time
    made->thread = number;
    RunningCall* next = first();
    do made->next = next;
    while (!first_.compare_exchange_weak(next, made));
    return made;
  }

  static inline constinit thread_local RunningCall* of_this_one = nullptr;
  static inline std::atomic<void (*)()> hook{nullptr};

 private:
  static inline std::atomic<RunningCall*> first_{nullptr};
};

template <class T>
T now(const std::atomic<T>& value) {
  return value.load(std::memory_order_relaxed);
}

/// Releases the call of a thread at the thread's end.
class CallOfThread {
 public:
  CallOfThread() { CallsOfThreads::of_this_one = CallsOfThreads::acquire(); }
  ~CallOfThread() {
    if (now(CallsOfThreads::of_this_one->callee)) return;  // exit() within a call: its readers may report it
    CallsOfThreads::of_this_one->thread = 0;
    CallsOfThreads::of_this_one = nullptr;
  }
  CallOfThread(const CallOfThread&) = delete;
  CallOfThread& operator=(const CallOfThread&) = delete;
};

/// Whether a message names a robot: "`rover_3`", "robot rover_3".
bool is_named_in(std::string_view message, std::string_view name) {
  for (std::size_t at = message.find(name); at != std::string_view::npos; at = message.find(name, at + 1)) {
    const std::string_view before = message.substr(0, at), behind = message.substr(at + name.size());
    if (before.ends_with('`') && behind.starts_with('`')) return true;
    if (before.ends_with("robot ") && (behind.empty() || std::string_view(" ,:;").find(behind[0]) != behind.npos))
      return true;
  }
  return false;
}

/// Returns the item that the call works on, when it is known. For an algorithm that several subsystems share, it is
/// else the first item that a message names.
const Callee::OfItem* item_of(const Callee& callee, const RunningCall& call, std::string_view told) {
  const std::uint32_t noted = now(call.note.item), begin = now(call.begin);
  if (noted < callee.items.size()) return &callee.items[noted];
  if (now(call.end) == begin + 1 && begin < callee.items.size()) return &callee.items[begin];
  if (callee.items.size() == 1) return callee.items.data();
  for (const Callee::OfItem& item : callee.items)
    if (!item.name.empty() && is_named_in(told, item.object)) return &item;
  return nullptr;
}

void add_quoted(SignalText& text, std::string_view name) {
  text.add("`");
  text.add_name(name);
  text.add("`");
}

}  // namespace

RunningCall& running_call() {
  if (!CallsOfThreads::of_this_one) {
    static thread_local const CallOfThread owner;
    if (!CallsOfThreads::of_this_one) CallsOfThreads::of_this_one = CallsOfThreads::acquire();  // the thread ends
    if (void (*const hook)() = CallsOfThreads::hook.load()) hook();
  }
  return *CallsOfThreads::of_this_one;
}

RunningCall* running_call_in_handler() noexcept { return CallsOfThreads::of_this_one; }

RunningCall* first_running_call() noexcept { return CallsOfThreads::first(); }

void set_thread_hook(void (*hook)()) {
  const bool known = CallsOfThreads::of_this_one != nullptr;
  CallsOfThreads::hook = hook;
  static_cast<void>(running_call());
  if (known) hook();
}

CallScope::CallScope(const Callee& callee, const char* function, std::int64_t time)
    : call_(running_call()),
      callee_(now(call_.callee)),
      function_(now(call_.function)),
      time_(now(call_.time)),
      items_{now(call_.begin), now(call_.end)},
      item_(now(call_.note.item)),
      library_(now(call_.note.library)) {
  call_.enter(&callee, time, {});
  call_.function.store(function, std::memory_order_relaxed);
}

CallScope::~CallScope() {
  call_.enter(callee_, time_, items_);
  call_.function.store(function_, std::memory_order_relaxed);
  call_.note.item.store(item_, std::memory_order_relaxed);
  call_.note.library.store(library_, std::memory_order_relaxed);
}

void add_who(SignalText& text, const RunningCall& call, std::string_view told) {
  const Callee* const callee = now(call.callee);
  if (!callee) return;
  const Callee::OfItem* const item = item_of(*callee, call, told);
  const std::string& place = item && !item->place.empty() ? item->place : callee->place;
  if (!place.empty()) {
    text.add_name(place);
    text.add(": ");
  }
  text.add_name(item && !item->name.empty() ? item->name : callee->name);
  if (!callee->use.empty()) {
    text.add(" (");
    text.add_name(callee->use);
    text.add(")");
  }
  if (item) {
    if (is_named_in(told, item->object)) return;
    text.add(item->is_robot ? ", robot " : ", object ");
    add_quoted(text, item->object);
    text.add(",");
    return;
  }
  const std::uint32_t begin = now(call.begin), end = now(call.end);
  if (begin >= end || end > callee->items.size()) return;
  for (std::uint32_t i = begin; i < end; ++i)
    if (is_named_in(told, callee->items[i].object)) return;
  text.add(", one of ");
  add_quoted(text, callee->items[begin].object);
  text.add(" to ");
  add_quoted(text, callee->items[end - 1].object);
  text.add(",");
}

void add_where(SignalText& text, const RunningCall& call) {
  const Callee* const callee = now(call.callee);
  if (!callee) return;
  const char* const library = now(call.note.library);
  text.add(" in `");
  text.add(library ? now(call.note.function) : now(call.function));
  text.add("`");
  if (library || !callee->library.empty()) {
    text.add(" of ");
    text.add_name(library ? std::string_view(library) : std::string_view(callee->library));
  }
  const std::int64_t time = now(call.time);
  if (time == RunningCall::no_time) return;
  text.add(" at t = ");
  text.add_seconds(time);
  text.add(" s");
}

std::string who(const RunningCall& call, std::string_view told) {
  SignalText text;
  add_who(text, call, told);
  return std::string(text.view());
}

void SignalText::write_to(int file) const {
  for (std::size_t done = 0; done < size_;) {
    const auto n = ::write(file, buffer_ + done, size_ - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    done += std::size_t(n);
  }
}

}  // namespace muro
