// SPDX-License-Identifier: MIT
#include "host/process/crash_report.hpp"

#include <execinfo.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

#include "core/running_call.hpp"

namespace muro::host {

namespace {

struct CrashSignal {
  int number;
  std::string_view name, meaning;
};
constexpr CrashSignal crash_signals[] = {{SIGSEGV, "SIGSEGV", "invalid memory access"},
                                         {SIGBUS, "SIGBUS", "access behind the end of a file"},
                                         {SIGFPE, "SIGFPE", "integer division by zero, or overflow"},
                                         {SIGILL, "SIGILL", "invalid instruction"},
                                         {SIGABRT, "SIGABRT", "it gave up by abort()"}};
std::array<struct sigaction, std::size(crash_signals)> previous_actions;  // a sanitizer's own, or the default
std::atomic<pid_t> crashing_thread{0};

/// Memory for a handler's stack: when a thread has used up its own stack, that one cannot be used.
class HandlerStack {
 public:
  HandlerStack() {
    stack_t present{};
    const bool has_one = sigaltstack(nullptr, &present) == 0 && (present.ss_flags & SS_DISABLE) == 0;
    if (has_one) return;  // a sanitizer's
    memory_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) return;
    stack_t stack{};
    stack.ss_sp = memory_;
    stack.ss_size = size;
    sigaltstack(&stack, nullptr);
  }
  ~HandlerStack() {
    if (memory_ == MAP_FAILED) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    munmap(memory_, size);
  }
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  static constexpr std::size_t size = 128 * 1024;
  void* memory_ = MAP_FAILED;
};

void give_stack_to_thread() { static thread_local const HandlerStack stack; }

void write_line(const CrashSignal& signal, const siginfo_t& info) {
  SignalText line;
  const RunningCall* const call = running_call_in_handler();
  if (call && call->callee.load()) {
    add_who(line, *call);
    line.add(" crashed");
    add_where(line, *call);
  } else if (call) {
    line.add("muro crashed, and no plugin was being called: this is an error of muro");
  } else {
    line.add("a thread crashed that a library has started");
  }
  line.add(": ");
  line.add(signal.name);
  line.add(", ");
  line.add(signal.meaning);
  if (signal.number == SIGSEGV || signal.number == SIGBUS) {
    line.add(" at 0x");
    line.add(reinterpret_cast<std::uintptr_t>(info.si_addr), 16);
  }
  line.add("; files that were being written end in .part\n");
  line.write_to(STDERR_FILENO);
}

/// Restores the earlier disposition and lets the signal come again, as if it had not been handled.
void die_by(std::size_t which, const siginfo_t& info) {
  sigaction(crash_signals[which].number, &previous_actions[which], nullptr);
  const bool is_fault = info.si_code > 0;  // the instruction fails again when the handler returns
  if (!is_fault || previous_actions[which].sa_handler == SIG_DFL) raise(crash_signals[which].number);
}

void handle_crash(int number, siginfo_t* info, void* /*context*/) {
  std::size_t which = 0;
  while (crash_signals[which].number != number) ++which;
  const pid_t self = gettid();
  pid_t none = 0;
  if (crashing_thread.compare_exchange_strong(none, self)) {
    write_line(crash_signals[which], *info);
    write_stack();
  } else if (none != self) {
    for (;;) pause();  // another thread has crashed and ends the process
  }
  die_by(which, *info);
}

}  // namespace

void write_stack() {
  std::array<void*, 48> frames{};
  const int count = backtrace(frames.data(), int(frames.size()));
  backtrace_symbols_fd(frames.data(), count, STDERR_FILENO);
}

void report_crashes() {
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads what it needs, which a handler must not do
  set_thread_hook(give_stack_to_thread);
  struct sigaction action {};
  action.sa_sigaction = handle_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGPIPE);  // the reader of standard error may have left
  for (const CrashSignal& s : crash_signals) sigaddset(&action.sa_mask, s.number);
  for (std::size_t i = 0; i < std::size(crash_signals); ++i)
    sigaction(crash_signals[i].number, &action, &previous_actions[i]);
}

}  // namespace muro::host
