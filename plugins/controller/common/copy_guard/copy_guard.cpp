// SPDX-License-Identifier: MIT
#include "copy_guard.hpp"

#include <pthread.h>
#include <unistd.h>

#include <cstring>
#include <string_view>

namespace muro {

namespace {

thread_local int calls = 0;  ///< number of calls of loaded code that this thread is in
bool is_copy = false;

/// Runs in the new process, which has only the thread that called fork().
void note_copy() { is_copy = calls > 0; }

void write_to_standard_error(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(STDERR_FILENO, text.data(), text.size());
    if (count <= 0) return;
    text.remove_prefix(std::size_t(count));
  }
}

}  // namespace

CopyGuard::CopyGuard() {
  static const int registered = pthread_atfork(nullptr, nullptr, note_copy);
  static_cast<void>(registered);
  ++calls;
}

CopyGuard::~CopyGuard() { --calls; }

void CopyGuard::end_copy(const char* function) {
  if (!is_copy) return;
  write_to_standard_error("a copy of the process, which code that was loaded has made by fork(), came back from `");
  write_to_standard_error(function);
  write_to_standard_error("` and was ended; what it forks is to call exec or _exit\n");
  _exit(0);
}

}  // namespace muro
