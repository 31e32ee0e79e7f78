// SPDX-License-Identifier: MIT
#include "host/process/standard_error.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace muro::host {

namespace {

ssize_t write_or_lose(void* /*cookie*/, const char* data, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = write(STDERR_FILENO, data + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += std::size_t(n);
  }
  return ssize_t(size);
}

}  // namespace

void lose_what_standard_error_refuses() {
  std::FILE* const file = fopencookie(nullptr, "w", {nullptr, write_or_lose, nullptr, nullptr});
  if (!file) return;
  std::setvbuf(file, nullptr, _IONBF, 0);
  stderr = file;
}

}  // namespace muro::host
