// SPDX-License-Identifier: MIT
#include "address_space.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace muro {

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

void bound_address_space(std::uint64_t bytes) {
  if (is_sanitized) return;
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace muro
