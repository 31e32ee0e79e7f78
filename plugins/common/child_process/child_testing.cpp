// SPDX-License-Identifier: MIT
// A child process for tests. It does what its argument says.
#include <dirent.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "as_child.hpp"

namespace {

using namespace muro;

void say(const std::string& text) { as_child::send(text.data(), text.size()); }
void say_number(int number) { as_child::send(&number, sizeof number); }

void tell_descriptors() {
  DIR* const all = opendir("/proc/self/fd");
  std::string text;
  while (const dirent* const entry = readdir(all))
    if (const int number = std::atoi(entry->d_name); entry->d_name[0] != '.' && number != dirfd(all))
      text += entry->d_name + std::string(" ");
  closedir(all);
  say(text);
}

void tell_signals() {
  sigset_t blocked;
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  struct sigaction action {};
  sigaction(SIGUSR1, nullptr, &action);
  say(std::string(sigismember(&blocked, SIGTERM) ? "blocked" : "free") + " " +
      (action.sa_handler == SIG_DFL ? "default" : "ignored"));
}

/// Starts a process that would live on, and has all descriptors of this one.
void start_another() {
  const pid_t other = fork();
  if (other == 0)
    for (;;) pause();
  say_number(other);
}

[[noreturn]] void wait_for_ever() {
  for (;;) pause();
}

void recurse(volatile char* above) {
  volatile char frame[4096];
  if (above[0] == 2) return;
  frame[0] = above[0];
  recurse(frame);
  above[0] = frame[0];
}

void tell_crash(int number, const siginfo_t&) { say_number(number); }

}  // namespace

int main(int, char** words) {
  if (!as_child::begin()) return 2;
  if (!as_child::end_with_parent()) return 1;
  const std::string does = words[1];
  if (does == "descriptors") tell_descriptors();
  if (does == "signals") tell_signals();
  if (does == "environment") say(std::string(std::getenv("MURO_TEST_A")) + " " + std::getenv("MURO_TEST_B"));
  if (does == "leave") return 5;
  if (does == "wait") wait_for_ever();
  if (does == "say_and_wait") say_number(0), wait_for_ever();
  if (does == "another") start_another();
  if (does == "another_and_wait") start_another(), wait_for_ever();
  if (does == "another_and_crash") start_another(), std::abort();
  if (does == "close_all") {
    say_number(getpid());
    closefrom(0);
    wait_for_ever();
  }
  if (does == "close_all_and_say") {
    closefrom(3);
    say("nobody hears that");
  }
  if (does == "recurse") {
    as_child::catch_crashes(tell_crash);
    volatile char first = 1;
    recurse(&first);
  }
  return 0;
}
