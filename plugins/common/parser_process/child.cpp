// SPDX-License-Identifier: MIT
#include "child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "plugins/common/text/one_line.hpp"

namespace muro::parser_process {

bool Child::start(const std::string& program, std::string& reason) {
  const auto fail = [&](int code) {
    reason = program + " cannot be started: " + std::strerror(code);
    if (code == ENOENT || code == EACCES || code == ENOEXEC) reason += "; install muro again";
    return false;
  };
  for (Descriptor* file : {&output_, &allowance_}) {
    file->reset(memfd_create(program_file, MFD_CLOEXEC));
    if (!file->keep_off_standard_streams()) return fail(errno);
  }
  const int code =
      process_.start({.program = program,
                      .files = {{output_.get(), 1}, {output_.get(), 2}, {allowance_.get(), process_allowance}},
                      // without a home, so that libraries keep no files there, and without a language
                      .environment = {"HOME=/dev/null", "LC_ALL=C"}});
  return code == 0 || fail(code);
}

bool Child::send(const void* data, std::uint64_t size) {
  return process_.send(data, size) == ChildProcess::Transfer::whole;
}

bool Child::receive(void* data, std::uint64_t size) {
  return process_.receive(data, size) == ChildProcess::Transfer::whole;
}

Child::Death Child::end() {
  Death death;
  static_cast<ChildProcess::End&>(death) = process_.end();
  death.last_words = last_line();
  death.allowed = allowance();
  return death;
}

void Child::clear_output() {
  if (ftruncate(output_.get(), 0) == 0) lseek(output_.get(), 0, SEEK_SET);
}

Allowance Child::allowance() const {
  Allowance allowed;
  if (pread(allowance_.get(), &allowed, sizeof allowed, 0) != ssize_t(sizeof allowed)) return {};
  return allowed;
}

std::string Child::last_line() const {
  char text[512];
  const off_t size = lseek(output_.get(), 0, SEEK_END);
  const ssize_t got =
      pread(output_.get(), text, sizeof text, size > off_t(sizeof text) ? size - off_t(sizeof text) : 0);
  std::string_view all(text, got > 0 ? std::size_t(got) : 0);
  while (!all.empty() && all.back() == '\n') all.remove_suffix(1);
  return one_line(all.substr(all.rfind('\n') + 1));  // npos + 1 is 0
}

}  // namespace muro::parser_process
