// SPDX-License-Identifier: MIT
#include "as_child.hpp"

#include <linux/close_range.h>
#include <poll.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace muro::as_child {

namespace {

pid_t parent = 0;
struct stat socket_at_start {};
std::atomic<bool> is_watched = false;
std::atomic<CrashHandler> crash_handler = nullptr;
alignas(64) char crash_stack[64 * 1024];  // a thread that has used up its own stack cannot use that

[[noreturn]] void end_group() {
  kill(-getpid(), SIGKILL);
  _exit(0);
}

/// Ends the process when the socket fails: the parent has ended, or the socket is no longer there.
[[noreturn]] void end_without_socket() {
  if (!has_socket()) _exit(exit_without_socket);
  end_group();
}

/// Watches the parent. The thread has its own table of descriptors, so that the socket stays open there whatever others
/// close. If the system does not support that, the thread checks whose child this process is.
void* watch_parent(void*) {
  constexpr int look = 500;  // ms; also needed when a fork of the parent has a copy of the socket
  const bool has_own_table = close_range(child_socket + 1, ~0u, CLOSE_RANGE_UNSHARE) == 0;
  if (has_own_table) close_range(0, child_socket - 1, 0);
  is_watched = true;
  is_watched.notify_all();
  pollfd other_side{has_own_table ? child_socket : -1, 0, 0};  // poll always reports its end
  while (poll(&other_side, 1, look) <= 0 && getppid() == parent) continue;
  end_group();
}

void on_crash(int number, siginfo_t* info, void*) {
  crash_handler.load()(number, *info);
  ::signal(number, SIG_DFL);
  raise(number);
}

}  // namespace

bool begin() {
  if (fstat(child_socket, &socket_at_start) != 0 || !S_ISSOCK(socket_at_start.st_mode)) return false;
  parent = getppid();
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  return true;
}

bool end_with_parent() {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, 64 * 1024);  // it may count as memory of the program
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the other threads
  pthread_t thread;
  const bool has_thread = pthread_create(&thread, &attributes, watch_parent, nullptr) == 0;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
  if (!has_thread) return false;
  pthread_detach(thread);
  is_watched.wait(false);
  return true;
}

bool has_socket() {
  struct stat now {};
  return fstat(child_socket, &now) == 0 && now.st_dev == socket_at_start.st_dev && now.st_ino == socket_at_start.st_ino;
}

void send(const void* data, std::size_t size) {
  for (const auto* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t sent = ::send(child_socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) end_without_socket();
    at += sent;
    size -= std::size_t(sent);
  }
}

void receive(void* data, std::size_t size) {
  for (auto* at = static_cast<char*>(data); size > 0;) {
    const ssize_t received = recv(child_socket, at, size, MSG_WAITALL);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) end_without_socket();
    at += received;
    size -= std::size_t(received);
  }
}

void catch_crashes(CrashHandler handler, std::initializer_list<int> more) {
  crash_handler = handler;
  stack_t own{};
  own.ss_sp = crash_stack;
  own.ss_size = sizeof crash_stack;
  sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(number, &action, nullptr);
  for (const int number : more) sigaction(number, &action, nullptr);
}

}  // namespace muro::as_child
