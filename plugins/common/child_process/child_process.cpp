// SPDX-License-Identifier: MIT
#include "child_process.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>

extern "C" {
#include <sys/pidfd.h>  // which does not say so itself before glibc 2.37
}

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "spawn.hpp"

namespace muro {

namespace {

/// Longest time from the end of the socket of a process that dies to its own end; usually some microseconds.
constexpr std::chrono::milliseconds patience_for_the_dying{100};

}  // namespace

bool ChildProcess::End::may_be_from_outside() const {
  constexpr int sent[] = {SIGKILL, SIGTERM, SIGINT, SIGQUIT, SIGHUP, SIGXCPU};
  return !was_ours && std::find(std::begin(sent), std::end(sent), signal) != std::end(sent);
}

int ChildProcess::start(const Setup& setup) {
  end();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
  socket_.reset(ends[0]);
  const Descriptor theirs(ends[1]);
  if (!socket_.keep_off_standard_streams()) return errno;
  pid_t pid = 0;
  if (const int code = spawn(setup, theirs.get(), pid); code != 0) return code;
  process_.reset(pidfd_open(pid, 0));
  if (!process_ && errno != ENOSYS) {
    const int code = errno;
    kill(-pid, SIGKILL);
    while (waitpid(pid, nullptr, 0) < 0 && errno == EINTR) continue;
    return code;
  }
  pid_ = pid;
  owner_ = getpid();
  return 0;
}

ChildProcess::operator bool() const { return pid_ != 0 && owner_ == getpid(); }

/// Calls poll() for the descriptor of the process, which is the first one, and others. If the system has no descriptors
/// of processes (valgrind, Linux before 5.3), it polls every 2 ms. It checks the process first, so that what it has
/// sent before its end has arrived by then.
int ChildProcess::poll_with_process(std::span<pollfd> descriptors, int milliseconds) const {
  if (process_) return poll(descriptors.data(), descriptors.size(), milliseconds);
  const Clock::time_point until = Clock::now() + std::chrono::milliseconds(milliseconds);
  for (;;) {
    siginfo_t info{};
    const bool ended = waitid(P_PID, id_t(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == pid_;
    descriptors[0].revents = ended ? POLLIN : 0;
    const int ready = poll(descriptors.data() + 1, descriptors.size() - 1, ended ? 0 : std::min(milliseconds, 2));
    if (ready < 0) return ready;
    if (ended || ready > 0) return ready + int(ended);
    if (Clock::now() >= until) return 0;
  }
}

bool ChildProcess::ends_within(std::chrono::milliseconds patience) const {
  if (!*this) return true;
  const Clock::time_point until = Clock::now() + patience;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd process{process_.get(), POLLIN, 0};
    const int ready = poll_with_process({&process, 1}, int(std::max<std::int64_t>(left, 0)));
    if (ready >= 0 || errno != EINTR) return ready != 0;
  }
}

void ChildProcess::signal(int number) {
  if (process_)
    pidfd_send_signal(process_.get(), number, nullptr, 0);
  else if (*this)
    kill(pid_, number);  // until it is waited for, no other process has its number
}

ChildProcess::End ChildProcess::end(std::chrono::milliseconds patience) {
  End how;
  if (*this) {
    how.was_ours = !ends_within(has_closed_socket_ ? std::max(patience, patience_for_the_dying) : patience);
    signal(SIGKILL);
    siginfo_t info{};
    // until it is waited for, its number is that of its group and of no other one
    if (waitid(P_PID, id_t(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0) kill(-pid_, SIGKILL);
    int done = 0;
    while ((done = waitid(P_PID, id_t(pid_), &info, WEXITED)) != 0 && errno == EINTR) continue;
    if (done == 0 && info.si_code == CLD_EXITED) how.exit_code = info.si_status;
    if (done == 0 && info.si_code != CLD_EXITED) how.signal = info.si_status;
  }
  process_.reset();
  pid_ = 0;
  has_closed_socket_ = false;
  return how;
}

/// Checks the process before its socket, so that what it has sent before its end has arrived by then.
ChildProcess::Transfer ChildProcess::wait_for(short event, Clock::time_point until) const {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return Transfer::late;
    pollfd both[] = {{process_.get(), POLLIN, 0}, {socket_.get(), event, 0}};
    const int ready = poll_with_process(both, int(std::min<std::int64_t>(left, 1'000'000'000)));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    return both[1].revents != 0 ? Transfer::whole : Transfer::broken;
  }
}

ChildProcess::Transfer ChildProcess::broken() {
  has_closed_socket_ = true;
  return Transfer::broken;
}

ChildProcess::Transfer ChildProcess::send(const void* data, std::size_t size, Clock::time_point until) {
  for (const auto* at = static_cast<const char*>(data); size > 0;) {
    if (const Transfer t = wait_for(POLLOUT, until); t != Transfer::whole) return t;
    const ssize_t sent = ::send(socket_.get(), at, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent <= 0) return broken();
    at += sent;
    size -= std::size_t(sent);
  }
  return Transfer::whole;
}

ChildProcess::Transfer ChildProcess::receive(void* data, std::size_t size, Clock::time_point until) {
  for (auto* at = static_cast<char*>(data); size > 0;) {
    if (const Transfer t = wait_for(POLLIN, until); t != Transfer::whole) return t;
    const ssize_t received = recv(socket_.get(), at, size, MSG_DONTWAIT);
    if (received < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (received <= 0) return broken();
    at += received;
    size -= std::size_t(received);
  }
  return Transfer::whole;
}

std::string ChildProcess::take_rest(std::size_t most) {
  std::string text;
  char some[4096];
  for (ssize_t got = 0; text.size() < most; text.append(some, std::size_t(got)))
    if ((got = recv(socket_.get(), some, std::min(sizeof some, most - text.size()), MSG_DONTWAIT)) <= 0) break;
  return text;
}

std::string name_of_signal(int number) {
  const char* const name = sigabbrev_np(number);
  return "SIG" + std::string(name ? name : std::to_string(number));
}

}  // namespace muro
