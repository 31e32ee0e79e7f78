// SPDX-License-Identifier: MIT
// A parser process for tests. It does what the request names, good or bad.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "service.hpp"

namespace muro::parser_process {
namespace {

const Registration echo("echo", [](Reader& request, Writer& answer) { answer.text(request.text()); });

const Registration pid("pid", [](Reader&, Writer& answer) { answer.value(getpid()); });

const Registration refuse("refuse", [](Reader& request, Writer&) { throw Error(request.text()); });

const Registration hang("hang", [](Reader&, Writer&) {
  for (volatile bool more = true; more;) {
  }
});

const Registration eat("eat", [](Reader&, Writer& answer) {
  std::vector<std::vector<char>> all(100);
  for (std::vector<char>& part : all) part.reserve(64 << 20);
  answer.value(all.size());
});

const Registration crash("crash", [](Reader&, Writer&) {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
});

const Registration abort_with_words("abort", [](Reader&, Writer&) {
  std::signal(SIGABRT, SIG_DFL);
  std::fputs("something else\ncorrupted \x1b[31m list\n", stderr);
  std::abort();
});

const Registration leave("leave", [](Reader&, Writer&) { _exit(5); });

const Registration chatter("chatter", [](Reader&, Writer& answer) {
  std::puts("a warning on standard output");
  std::fflush(stdout);
  std::cerr << "a warning on standard error" << std::endl;
  answer.text(std::getenv("HOME"));
});

}  // namespace
}  // namespace muro::parser_process
