// SPDX-License-Identifier: MIT
#include "host/process/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

#include "core/running_call.hpp"

namespace muro::host {

namespace {

constexpr int interrupts[] = {SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, std::size(interrupts)> dispositions_before;
std::atomic<int> signals_received{0};
static_assert(std::atomic<int>::is_always_lock_free);

void end_at_once(int number) {
  for (const RunningCall* call = first_running_call(); call; call = call->next.load()) {
    if (call->thread.load() == 0 || !call->callee.load()) continue;
    SignalText line;
    line.add("\nended while this was busy: ");
    add_who(line, *call);
    add_where(line, *call);
    line.add("\n");
    line.write_to(STDERR_FILENO);
  }
  std::signal(number, SIG_DFL);
  raise(number);
}

void receive(int number) {
  if (signals_received.fetch_add(1) > 0) end_at_once(number);
}

}  // namespace

Interrupt::Interrupt() {
  signals_received = 0;
  struct sigaction action {};
  action.sa_handler = receive;
  action.sa_flags = SA_RESTART;  // reading and writing of plugins goes on
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(interrupts); ++i) {
    sigaction(interrupts[i], nullptr, &dispositions_before[i]);
    const bool by_nohup = interrupts[i] == SIGHUP && dispositions_before[i].sa_handler == SIG_IGN;
    if (!by_nohup) sigaction(interrupts[i], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < std::size(interrupts); ++i) sigaction(interrupts[i], &dispositions_before[i], nullptr);
}

bool Interrupt::pending() { return signals_received.load(std::memory_order_relaxed) > 0; }

}  // namespace muro::host
