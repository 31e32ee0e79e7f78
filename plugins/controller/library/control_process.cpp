// SPDX-License-Identifier: MIT
#include "control_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h>  // which does not say so itself before glibc 2.37
}

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "control_library.hpp"
#include "plugins/common/text/one_line.hpp"
#include "process_protocol.hpp"

namespace muro::control {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int above_those_of_child = 16;

/// A number that is none of those that the child gets, since each is put in place after the other.
bool raise_number(Descriptor& d) {
  if (d) d.reset(fcntl(d.get(), F_DUPFD_CLOEXEC, above_those_of_child));
  return bool(d);
}

/// What posix_spawn is told.
class ControlSpawn {
 public:
  ControlSpawn(int output, int socket, int memory) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, output, 1);
    posix_spawn_file_actions_adddup2(&files_, output, 2);
    posix_spawn_file_actions_adddup2(&files_, socket, process_socket);
    posix_spawn_file_actions_adddup2(&files_, memory, process_memory);
    posix_spawn_file_actions_addclosefrom_np(&files_, process_memory + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    // of a group of its own: Ctrl-C is for the simulation
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~ControlSpawn() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  ControlSpawn(const ControlSpawn&) = delete;
  ControlSpawn& operator=(const ControlSpawn&) = delete;

  int spawn(const std::string& program, pid_t& pid) {
    // a child may go by the end of the thread that has started it where that is the one that lives longest
    std::string name = process_file, starter = gettid() == getpid() ? "main" : "other";
    char* arguments[] = {name.data(), starter.data(), nullptr};
    return posix_spawn(&pid, program.c_str(), &files_, &attributes_, arguments, environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

std::string meaning_of(int signal) {
  const char* const name = sigabbrev_np(signal);
  std::string text = "SIG" + std::string(name ? name : std::to_string(signal));
  switch (signal) {
    case SIGSEGV:
      return text + ", invalid memory access";
    case SIGBUS:
      return text + ", access behind the end of a file";
    case SIGFPE:
      return text + ", integer division by zero, or overflow";
    case SIGILL:
      return text + ", invalid instruction";
    case SIGABRT:
      return text + ", it gave up by abort()";
    case SIGKILL:
      return text + ", maybe because the system was short of memory";
    default:
      return text;
  }
}

}  // namespace

ControlProcess::ControlProcess(const std::string& library, const ProcessLimits& limits)
    : library_(library), limits_(limits) {
  try {
    start();
    Writer request;
    request.text(library);
    const std::vector<std::byte> answer = ask(request.bytes());
    Reader reader(answer);
    table_ = read_table(reader);
  } catch (...) {
    if (process_) end(false);
    throw;
  }
}

ControlProcess::~ControlProcess() {
  if (process_) end(false);
}

void ControlProcess::start() {
  const std::string program = (std::filesystem::path(own_folder()) / "controllers" / process_file).string();
  const auto fail = [&](int code) {
    throw ProcessError("cannot run in a process of its own (`isolate: process`): " + program +
                       " cannot be started: " + std::strerror(code) +
                       (code == ENOENT || code == EACCES || code == ENOEXEC ? "; install muro again"
                        : code == EMFILE ? "; a process for each robot takes three files, `ulimit -n` allows more"
                                         : ""));
  };
  int ends[2], pipe_ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno);
  socket_.reset(ends[0]);
  Descriptor theirs(ends[1]);
  // what does not fit into the pipe is lost: the control code never waits for somebody who reads
  if (pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) != 0) fail(errno);
  output_.reset(pipe_ends[0]);
  Descriptor their_output(pipe_ends[1]);
  if (!memory_.create(process_file)) fail(errno);
  for (Descriptor* d : {&socket_, &theirs, &output_, &their_output})
    if (!raise_number(*d)) fail(errno);
  pid_t pid = 0;
  ControlSpawn settings(their_output.get(), theirs.get(), memory_.descriptor());
  if (const int code = settings.spawn(program, pid); code != 0) fail(code);
  process_.reset(pidfd_open(pid, 0));
  if (!process_) {
    const int code = errno;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    fail(code);
  }
  theirs.reset();
  Greeting greeting{};
  const Greeting ours = Greeting::ours();
  const std::string problem = receive(&greeting, sizeof greeting, Clock::now() + std::chrono::seconds(10));
  if (!problem.empty()) throw ProcessError("cannot run in a process of its own: " + program + " " + problem);
  if (std::memcmp(&greeting, &ours, sizeof ours) != 0)
    throw ProcessError("cannot run in a process of its own: " + program + " is of another muro; install muro again");
}

/// Returns what became of the process when it does not answer.
std::string ControlProcess::receive(void* data, std::uint64_t size, Clock::time_point until) {
  auto* at = static_cast<char*>(data);
  const auto said = [](const Outcome& death) { return death.reason.empty() ? "" : ": " + death.reason; };
  while (size > 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd socket{socket_.get(), POLLIN, 0};
    if (left <= 0 || (poll(&socket, 1, int(left)) == 0)) {
      end(true);
      return "did not return in time";
    }
    const ssize_t received = recv(socket_.get(), at, size, MSG_DONTWAIT);
    if (received < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (received <= 0) {
      const Outcome death = end(false);
      return (death.ending == Ending::exited ? "ended its process" : "crashed") + said(death) +
             (death.stack.empty() ? "" : "; its calls: " + one_line(death.stack));
    }
    at += received;
    size -= std::uint64_t(received);
  }
  return "";
}

std::vector<std::byte> ControlProcess::ask(std::span<const std::byte> request) {
  // to load a library from a slow disk is no call of control code
  const double seconds = std::max(limits_.timeout, 10.0);
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const MessageHeader size{request.size(), 0};
  const auto send_all = [&](const void* data, std::size_t bytes) {
    return ::send(socket_.get(), data, bytes, MSG_NOSIGNAL) == ssize_t(bytes);
  };
  if (send_all(&size, sizeof size)) send_all(request.data(), request.size());  // else it is gone, as receive() finds
  MessageHeader header;
  std::string problem = receive(&header, sizeof header, until);
  std::vector<std::byte> answer(problem.empty() ? std::min<std::uint64_t>(header.size, 64u << 20) : 0);
  if (problem.empty()) problem = receive(answer.data(), answer.size(), until);
  if (!problem.empty()) throw ProcessError("library " + library_ + " " + problem + " when it was loaded");
  if (header.is_refusal != 0) throw Error(std::string(reinterpret_cast<const char*>(answer.data()), answer.size()));
  return answer;
}

void ControlProcess::prepare(std::span<const std::byte> message) {
  ask(message);
  memory_.close();  // both have mapped it
}

bool ControlProcess::is_alive() const {
  pollfd process{process_.get(), POLLIN, 0};
  return process_ && poll(&process, 1, 0) == 0;
}

/// What it has written to the socket since it was prepared.
std::string ControlProcess::stack_of_calls() {
  std::string text;
  char some[4096];
  for (ssize_t got = 0; (got = recv(socket_.get(), some, sizeof some, MSG_DONTWAIT)) > 0 && text.size() < 32768;)
    text.append(some, std::size_t(got));
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

Outcome ControlProcess::reap() {
  Outcome death{.ending = Ending::crashed};
  siginfo_t info{};
  int done = 0;
  while ((done = waitid(P_PIDFD, id_t(process_.get()), &info, WEXITED)) != 0 && errno == EINTR) continue;
  process_.reset();
  if (done != 0) {
    death.reason = "nobody knows how";
  } else if (info.si_code == CLD_EXITED) {
    death.ending = Ending::exited;
    death.reason = "exit code " + std::to_string(info.si_status);
  } else {
    death.reason = meaning_of(info.si_status);
  }
  return death;
}

Outcome ControlProcess::end(bool timed_out) {
  if (!process_) return {.ending = Ending::no_process};
  if (timed_out) {
    constexpr int patience = 1000;  // ms
    pidfd_send_signal(process_.get(), SIGALRM, nullptr, 0);
    pollfd process{process_.get(), POLLIN, 0};
    poll(&process, 1, patience);
  }
  // one that hangs; it changes nothing for one that is dead already
  if (timed_out || is_alive()) pidfd_send_signal(process_.get(), SIGKILL, nullptr, 0);
  Outcome death = reap();
  death.stack = stack_of_calls();
  if (timed_out) death.ending = Ending::timed_out;
  return death;
}

std::string ControlProcess::take_output() {
  constexpr std::size_t most = 64 * 1024;
  std::string text;
  char some[4096];
  for (ssize_t got = 0; text.size() < most && (got = read(output_.get(), some, sizeof some)) > 0;)
    text.append(some, std::size_t(got));
  return text;
}

}  // namespace muro::control
