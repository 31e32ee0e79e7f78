// SPDX-License-Identifier: MIT
#include "crash_note.hpp"

#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <new>

#include "plugins/common/child_process/address_space.hpp"
#include "plugins/common/child_process/as_child.hpp"
#include "process_protocol.hpp"

namespace muro::control {

namespace {

SharedHeader* noted = nullptr;
std::uint64_t bound = 0;  // bytes of address space; 0: none

/// Throws bad_alloc as C++ requires when there is no memory, and notes it.
void note_short_of_memory() {
  if (noted) noted->is_short_of_memory = 1;
  throw std::bad_alloc();
}

/// Whether another process has sent the signal.
bool is_of_others(const siginfo_t& info) {
  const bool is_sent = info.si_code == SI_USER || info.si_code == SI_QUEUE || info.si_code == SI_TKILL;
  return is_sent && info.si_pid != getpid();
}

void note_crash(int number, const siginfo_t& info) {
  if (noted) {
    SharedHeader& h = *noted;
    h.signal = number;
    const bool has_address = (number == SIGSEGV || number == SIGBUS) && info.si_code > 0;
    h.fault_address = has_address ? std::uint64_t(reinterpret_cast<std::uintptr_t>(info.si_addr)) : ~std::uint64_t(0);
    h.is_short_of_memory = bound > 0 && own_address_space() > bound - bound / 16 ? 1 : 0;
    h.is_signal_of_others = is_of_others(info) ? 1 : 0;
  }
  if (!as_child::has_socket()) return;  // else the descriptor may be a file of the control code
  std::array<void*, 48> frames{};
  backtrace_symbols_fd(frames.data(), backtrace(frames.data(), int(frames.size())), child_socket);
}

}  // namespace

void leave_crash_notes() {
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads libraries that a signal handler could not load
  as_child::catch_crashes(note_crash, {SIGALRM});
}

void leave_crash_notes_in(SharedHeader& header) { noted = &header; }

void bound_memory(std::uint64_t bytes) {
  if (is_sanitized) return;
  bound = own_address_space() + bytes;
  std::set_new_handler(note_short_of_memory);
  bound_address_space(bound);
}

}  // namespace muro::control
