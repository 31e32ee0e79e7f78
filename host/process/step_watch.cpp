// SPDX-License-Identifier: MIT
#include "host/process/step_watch.hpp"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <system_error>

#include "core/running_call.hpp"
#include "host/process/crash_report.hpp"
#include "host/process/exit_guard.hpp"

namespace muro::host {

namespace {

constexpr int looks_per_timeout =
    20;  // observations of the same call that are needed; a process that was stopped for a while has only one

/// The position of a call in the run, which distinguishes it from others.
struct Seen {
  const Callee* callee = nullptr;
  std::int64_t time = 0;
  std::uint32_t begin = 0;
  int times = 0;

  bool is_same(const Seen& other) const { return callee == other.callee && time == other.time && begin == other.begin; }
};

Seen step_of(const RunningCall& call) {
  Seen seen{call.callee.load(), call.time.load(), call.begin.load()};
  const bool counts = seen.callee && !seen.callee->runs_alone && seen.time != RunningCall::no_time;
  return call.thread.load() != 0 && counts ? seen : Seen{};
}

/// Makes the thread print its own stack, and waits a moment for that.
void show_stack_of(const RunningCall& call) {
  const int number = SIGRTMIN + 7;
  struct sigaction action {};
  action.sa_handler = [](int) { write_stack(); };
  action.sa_flags = SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
  syscall(SYS_tgkill, getpid(), pid_t(call.thread.load()), number);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
}

[[noreturn]] void end_process(const RunningCall& call, double timeout) {
  SignalText line;
  add_who(line, call);
  line.add(" hangs");
  add_where(line, call);
  line.add(": it has not returned for ");
  line.add_seconds(std::int64_t(1e9 * timeout));
  line.add(" s (--step-timeout); files that were being written end in .part\n");
  line.write_to(STDERR_FILENO);
  show_stack_of(call);
  ExitGuard::leave(1);
}

}  // namespace

StepWatch::StepWatch(double timeout) : timeout_(timeout) {
  if (!(timeout_ > 0)) return;
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error& e) {
    fmt::print(stderr,
               "warning: no thread can be started for --step-timeout ({}); nobody watches for calls that hang\n",
               e.code().message());
  }
}

StepWatch::~StepWatch() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void StepWatch::watch() {
  std::map<const RunningCall*, Seen> seen;
  std::unique_lock lock(mutex_);
  const std::chrono::duration<double> interval(timeout_ / looks_per_timeout);
  while (!changed_.wait_for(lock, interval, [&] { return ends_; }))
    for (const RunningCall* call = first_running_call(); call; call = call->next.load()) {
      const Seen now = step_of(*call);
      Seen& before = seen[call];
      const int times = now.callee && now.is_same(before) ? before.times + 1 : 0;
      before = now;
      before.times = times;
      if (times >= looks_per_timeout) end_process(*call, timeout_);
    }
}

}  // namespace muro::host
