// SPDX-License-Identifier: MIT
#include "host/process/exit_guard.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "core/running_call.hpp"

namespace muro::host {

namespace {

std::atomic<pid_t> guarded_process{0};  // a process that a library has forked may call exit()

/// Reports an end of the process. `what`: the caller's action.
void check(const char* what) {
  if (guarded_process.load() != getpid()) return;
  SignalText line;
  const RunningCall& call = running_call();
  if (call.callee.load()) {
    add_who(line, call);
    line.add(what);
    add_where(line, call);
  } else {
    line.add("a library");
    line.add(what);
  }
  line.add("; files that were being written end in .part\n");
  std::signal(SIGPIPE, SIG_IGN);
  std::fflush(stdout);
  line.write_to(STDERR_FILENO);
  ExitGuard::leave(1);
}
void check_exit() { check(" ended the program by exit()"); }

}  // namespace

ExitGuard::ExitGuard() {
  guarded_process = getpid();
  renew();
}

void ExitGuard::renew() {
  if (guarded_process.load() == 0) return;
  std::atexit(check_exit);
  at_quick_exit(check_exit);
}

void ExitGuard::leave(int code) {
  for (;;) syscall(SYS_exit_group, code);
}

void ExitGuard::leave_for_others(int code) {
  check(" ended the program by _exit()");
  leave(code);
}

ExitGuard::~ExitGuard() { guarded_process = 0; }

}  // namespace muro::host
