// SPDX-License-Identifier: MIT
#include "child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h>  // which does not say so itself before glibc 2.37
}

#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "plugins/common/text/one_line.hpp"

namespace muro::parser_process {

namespace {

/// As ours, but without a home, so that libraries keep no files there, and in no language.
std::vector<std::string> environment_of_child() {
  std::vector<std::string> all{"HOME=/dev/null", "LC_ALL=C"};
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text = *entry;
    if (!text.starts_with("HOME=") && !text.starts_with("LC_ALL=")) all.emplace_back(text);
  }
  return all;
}

/// What posix_spawn is told.
class SpawnSettings {
 public:
  SpawnSettings(int socket, int output, int allowance) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, output, 1);
    posix_spawn_file_actions_adddup2(&files_, output, 2);
    posix_spawn_file_actions_adddup2(&files_, socket, process_socket);
    posix_spawn_file_actions_adddup2(&files_, allowance, process_allowance);
    posix_spawn_file_actions_addclosefrom_np(&files_, process_allowance + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    // of a group of its own: Ctrl-C is for the program that reads
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  int spawn(const std::string& program, pid_t& pid) {
    std::vector<std::string> environment = environment_of_child();
    std::vector<char*> entries;
    for (std::string& e : environment) entries.push_back(e.data());
    entries.push_back(nullptr);
    std::string name = program_file;
    char* arguments[] = {name.data(), nullptr};
    return posix_spawn(&pid, program.c_str(), &files_, &attributes_, arguments, entries.data());
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

}  // namespace

bool Child::start(const std::string& program, std::string& reason) {
  abandon();
  const auto fail = [&](int code) {
    reason = program + " cannot be started: " + std::strerror(code);
    if (code == ENOENT || code == EACCES || code == ENOEXEC) reason += "; install muro again";
    abandon();
    return false;
  };
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return fail(errno);
  socket_.reset(ends[0]);
  Descriptor theirs(ends[1]);
  output_.reset(memfd_create(program_file, MFD_CLOEXEC));
  allowance_.reset(memfd_create(program_file, MFD_CLOEXEC));
  if (!output_ || !allowance_) return fail(errno);
  // Numbers above those that it gets, since each is put in place after the other; and ours is no standard stream, where
  // one was closed.
  for (Descriptor* d : {&socket_, &theirs, &output_, &allowance_})
    if (d->get() <= process_allowance) d->reset(fcntl(d->get(), F_DUPFD_CLOEXEC, process_allowance + 1));
  if (!socket_ || !theirs || !output_ || !allowance_) return fail(EMFILE);
  pid_t pid = 0;
  SpawnSettings settings(theirs.get(), output_.get(), allowance_.get());
  if (const int code = settings.spawn(program, pid); code != 0) return fail(code);
  process_.reset(pidfd_open(pid, 0));
  owner_ = getpid();
  return true;
}

bool Child::is_there() const { return socket_ && owner_ == getpid(); }

bool Child::send(const void* data, std::uint64_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket_.get(), at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= std::uint64_t(sent);
  }
  return true;
}

bool Child::receive(void* data, std::uint64_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = recv(socket_.get(), at, size, MSG_WAITALL);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    at += received;
    size -= std::uint64_t(received);
  }
  return true;
}

Child::Death Child::end() {
  Death death;
  death.code = -1;
  socket_.reset();
  if (process_) {
    // one that hangs without its socket; it changes nothing for one that is dead already
    pidfd_send_signal(process_.get(), SIGKILL, nullptr, 0);
    siginfo_t info{};
    int done = 0;
    while ((done = waitid(P_PIDFD, id_t(process_.get()), &info, WEXITED)) != 0 && errno == EINTR) {
    }
    if (done == 0 && info.si_code == CLD_EXITED) death.code = info.si_status;
    if (done == 0 && info.si_code != CLD_EXITED) death.signal = info.si_status;
  }
  death.last_words = last_line();
  death.allowed = allowance();
  abandon();
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

void Child::abandon() {
  allowance_.reset();
  socket_.reset();
  process_.reset();
  output_.reset();
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
