// SPDX-License-Identifier: MIT
#include "crash_note.hpp"

#include <execinfo.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <new>

#include "process_protocol.hpp"

namespace muro::control {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

SharedHeader* noted = nullptr;
std::uint64_t bound = 0;            // bytes of address space
alignas(64) char stack[64 * 1024];  // that of a thread that has used up its own is of no use

/// Bytes. May be called in signal handlers.
std::uint64_t own_address_space() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  char text[64];
  const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text);
  if (file >= 0) close(file);
  std::uint64_t pages = 0;
  for (ssize_t i = 0; i < size && text[i] >= '0' && text[i] <= '9'; ++i)
    pages = 10 * pages + std::uint64_t(text[i] - '0');
  return pages * std::uint64_t(getpagesize());
}

/// As the language has it where there is no memory, but noted.
void note_short_of_memory() {
  if (noted) noted->is_short_of_memory = 1;
  throw std::bad_alloc();
}

void note_crash(int number, siginfo_t* info, void*) {
  if (noted) {
    SharedHeader& h = *noted;
    h.signal = number;
    const bool has_address = number == SIGSEGV || number == SIGBUS;
    h.fault_address = has_address ? std::uint64_t(reinterpret_cast<std::uintptr_t>(info->si_addr)) : ~std::uint64_t(0);
    h.is_short_of_memory = bound > 0 && own_address_space() > bound - bound / 16 ? 1 : 0;
  }
  std::array<void*, 48> frames{};
  backtrace_symbols_fd(frames.data(), backtrace(frames.data(), int(frames.size())), process_socket);
  std::signal(number, SIG_DFL);
  raise(number);
}

}  // namespace

void leave_crash_notes() {
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads what it needs, which is no matter for a handler
  stack_t own{};
  own.ss_sp = stack;
  own.ss_size = sizeof stack;
  sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_sigaction = note_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) sigaction(number, &action, nullptr);
}

void leave_crash_notes_in(SharedHeader& header) { noted = &header; }

void bound_memory(std::uint64_t bytes) {
  if (is_sanitized) return;
  bound = own_address_space() + bytes;
  std::set_new_handler(note_short_of_memory);
  const rlimit limit{bound, bound};
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace muro::control
