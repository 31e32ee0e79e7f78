// SPDX-License-Identifier: MIT
#include "instance_process.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "muro/algorithm.hpp"
#include "remote_protocol.hpp"

namespace muro::fmu {

namespace {

using Clock = std::chrono::steady_clock;

std::string host_program() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&host_program), &info) == 0 || !info.dli_fname) return process_file;
  std::error_code unused;
  const auto folder = std::filesystem::absolute(info.dli_fname, unused).parent_path();
  return (folder / "controllers" / process_file).string();
}

/// Starts the program with the socket as descriptor `process_socket`; returns an error number, or 0.
int spawn_host(const std::string& program, int socket, pid_t& pid) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, socket, process_socket);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, process_socket + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  // of a group of its own: Ctrl-C is for the simulation
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::string name = process_file, word = "serve";
  char* arguments[] = {name.data(), word.data(), nullptr};
  const int code = posix_spawn(&pid, program.c_str(), &files, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return code;
}

}  // namespace

InstanceProcess::InstanceProcess(double timeout) : timeout_(timeout) {
  const std::string program = host_program();
  const auto fail = [&](int code) {
    throw Error("the program for a process of its own, " + program + ", cannot be started: " + std::strerror(code) +
                (code == ENOENT || code == EACCES ? "; install muro again" : ""));
  };
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno);
  constexpr int above_those_of_child = 16;
  socket_.reset(ends[0]);
  Descriptor theirs(fcntl(ends[1], F_DUPFD_CLOEXEC, above_those_of_child));
  const int problem = theirs ? 0 : errno;
  close(ends[1]);
  if (problem != 0) fail(problem);
  if (const int code = spawn_host(program, theirs.get(), pid_); code != 0) {
    pid_ = 0;
    fail(code);
  }
  theirs.reset();
  Greeting greeting;
  const Greeting ours;
  receive(&greeting, sizeof greeting);
  if (std::memcmp(&greeting, &ours, sizeof ours) != 0) {
    reap();
    throw Error("the program for a process of its own, " + program + ", is of another muro; install muro again");
  }
}

InstanceProcess::~InstanceProcess() {
  if (pid_ > 0) reap();
}

std::vector<std::byte> InstanceProcess::ask(std::span<const std::byte> request) {
  const std::uint64_t size = request.size();
  const auto send_all = [&](const void* data, std::size_t bytes) {
    const auto* at = static_cast<const char*>(data);
    while (bytes > 0) {
      const ssize_t sent = send(socket_.get(), at, bytes, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return;  // it is gone, as receive() finds
      at += sent;
      bytes -= std::size_t(sent);
    }
  };
  send_all(&size, sizeof size);
  send_all(request.data(), request.size());
  std::uint64_t answer_size = 0;
  receive(&answer_size, sizeof answer_size);
  if (answer_size > largest_message) throw Error("its process " + reap() + " after an answer that makes no sense");
  std::vector<std::byte> answer(answer_size);
  receive(answer.data(), answer.size());
  return answer;
}

void InstanceProcess::receive(void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  const auto until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_));
  while (size > 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd socket{socket_.get(), POLLIN, 0};
    const int ready = left > 0 ? poll(&socket, 1, int(std::min<long long>(left, 1'000'000'000))) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 && left <= 0) {
      reap();
      throw Error("it did not return within `timeout` of " + std::to_string(timeout_) + " s");
    }
    const ssize_t received = ready > 0 ? recv(socket_.get(), at, size, MSG_DONTWAIT) : -1;
    if (received < 0 && (errno == EINTR || errno == EAGAIN || ready == 0)) continue;
    if (received <= 0) throw Error("its process " + reap());
    at += received;
    size -= std::size_t(received);
  }
}

std::string InstanceProcess::reap() {
  if (pid_ <= 0) return "is gone";
  int status = 0;
  pid_t done = 0;
  constexpr int patience = 100;  // ms, for one that is dying
  for (int i = 0; i < patience && (done = waitpid(pid_, &status, WNOHANG)) == 0; ++i) usleep(1000);
  if (done == 0) {
    kill(pid_, SIGKILL);
    while ((done = waitpid(pid_, &status, 0)) < 0 && errno == EINTR) continue;
  }
  pid_ = 0;
  socket_.reset();
  if (done < 0) return "has ended";
  if (WIFEXITED(status)) return "has ended with exit code " + std::to_string(WEXITSTATUS(status));
  const char* const name = sigabbrev_np(WTERMSIG(status));
  return "was killed by SIG" + std::string(name ? name : std::to_string(WTERMSIG(status)));
}

}  // namespace muro::fmu
