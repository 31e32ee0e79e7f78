// SPDX-License-Identifier: MIT
#include "host/outputs/standard_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace muro::host {

void keep_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // The wrong direction of input and output, so that reading or printing fails as before. Notes may be lost.
    const int opened = open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened != stream && opened >= 0) close(opened);
  }
}

bool standard_output_failed() { return std::ferror(stdout) != 0; }

int close_standard_output(int exit_code) {
  const bool failed_before = standard_output_failed();
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed_before) return exit_code;
  // A second try gives the reason of an earlier failure.
  if (errno == 0) {
    std::clearerr(stdout);
    std::fputc('\n', stdout);
    std::fflush(stdout);
  }
  if (errno == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  fmt::print(stderr, "standard output cannot be written: {}\n",
             errno == 0 ? "a part of it is missing" : std::strerror(errno));
  return exit_code == 0 ? 1 : exit_code;
}

}  // namespace muro::host
