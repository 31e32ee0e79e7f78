// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "descriptor.hpp"

namespace muro {

/// Number of the socket's descriptor in every child process.
inline constexpr int child_socket = 3;

/// A program that runs beside this one, with a socket to it, and all processes that it starts. They are one process
/// group and end with this object. After a fork they belong to the process that has started them, and the other process
/// leaves them alone.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::time_point no_deadline = Clock::time_point::max();

  /// A descriptor of this process, which stays open here, and its number in the child.
  struct File {
    int ours = -1, number = -1;
  };
  struct Setup {
    std::string program;                     ///< a path
    std::vector<std::string> arguments{};    ///< after its name
    std::vector<File> files{};               ///< different numbers, none of them that of the socket
    std::vector<std::string> environment{};  ///< "NAME=value"; replaces our variables of that name
  };
  /// The way in which a process has ended.
  struct End {
    int signal = 0;         ///< 0: ended on its own
    int exit_code = -1;     ///< -1: unknown
    bool was_ours = false;  ///< it still ran, and this object killed it

    /// Whether the signal is one that others send and no error of the process causes: SIGKILL, SIGTERM, ...
    bool may_be_from_outside() const;
  };
  enum class Transfer {
    whole,
    broken,  ///< the process has ended, or closed its socket
    late,
  };

  ChildProcess() = default;
  ~ChildProcess() { end(); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Starts the process, in place of the one before. It reads /dev/null and prints where we do, unless `files` says
  /// otherwise, and has no other descriptor of ours. All signals have their default action; no signal is blocked.
  /// Returns 0, or an error number.
  int start(const Setup& setup);
  /// Whether there is a process for which end() has not been called yet.
  explicit operator bool() const;
  bool is_running() const { return *this && !ends_within(std::chrono::milliseconds(0)); }
  bool ends_within(std::chrono::milliseconds patience) const;
  /// Sends a signal to the process alone.
  void signal(int number);
  /// Waits for the end of the process, kills it if it takes longer than `patience`, and kills those that it has
  /// started. After a broken transfer it waits for at least 100 ms: a process closes its socket before the system
  /// reports its end.
  End end(std::chrono::milliseconds patience = std::chrono::milliseconds(0));

  Transfer send(const void* data, std::size_t size, Clock::time_point until = no_deadline);
  Transfer receive(void* data, std::size_t size, Clock::time_point until = no_deadline);
  /// Returns what it has sent and nobody has received, also after its end: `most` bytes at most.
  std::string take_rest(std::size_t most);

 private:
  int poll_with_process(std::span<pollfd> descriptors, int milliseconds) const;
  Transfer wait_for(short event, Clock::time_point until) const;
  Transfer broken();

  Descriptor socket_, process_;  ///< `process_` may be empty: see poll_with_process()
  bool has_closed_socket_ = false;
  pid_t pid_ = 0;    ///< 0: there is none
  pid_t owner_ = 0;  ///< process that has started it; after a fork another one has copies of the descriptors
};

/// Returns the name of a signal, such as "SIGSEGV".
std::string name_of_signal(int number);

}  // namespace muro
