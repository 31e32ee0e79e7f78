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

/// The number of its socket in every child process.
inline constexpr int child_socket = 3;

/// A program that runs beside this one, with a socket to it, and all processes that it starts: they are of one process
/// group, and end with this. After a fork they are those of the process that has started them, and no matter of the
/// other one.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::time_point no_deadline = Clock::time_point::max();

  /// A descriptor of ours, which stays ours, and its number in the child.
  struct File {
    int ours = -1, number = -1;
  };
  struct Setup {
    std::string program;                     ///< a path
    std::vector<std::string> arguments{};    ///< behind its name
    std::vector<File> files{};               ///< no two of one number, and none of that of its socket
    std::vector<std::string> environment{};  ///< "NAME=value", in place of those of ours
  };
  /// How it has ended.
  struct End {
    int signal = 0;         ///< 0: by itself
    int exit_code = -1;     ///< -1: unknown
    bool was_ours = false;  ///< it still ran, and was killed by this

    /// By a signal that others send, and that no mistake of the process itself brings about: SIGKILL, SIGTERM, ...
    bool may_be_from_outside() const;
  };
  enum class Transfer {
    whole,
    broken,  ///< it has ended, or closed its socket
    late,
  };

  ChildProcess() = default;
  ~ChildProcess() { end(); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Starts it, in place of the one before. It reads /dev/null and prints where we do, unless `files` says otherwise,
  /// and has no other descriptor of ours; all signals do what they do by default, and none is blocked. Returns 0, or an
  /// error number.
  int start(const Setup& setup);
  /// Whether end() has not been called for it yet.
  explicit operator bool() const;
  bool is_running() const { return *this && !ends_within(std::chrono::milliseconds(0)); }
  bool ends_within(std::chrono::milliseconds patience) const;
  /// To the process alone.
  void signal(int number);
  /// Waits for its end, kills it when it takes longer than that, and kills those that it has started. Where a transfer
  /// was broken it waits for 100 ms at least: a process closes its socket before the system says how it has ended.
  End end(std::chrono::milliseconds patience = std::chrono::milliseconds(0));

  Transfer send(const void* data, std::size_t size, Clock::time_point until = no_deadline);
  Transfer receive(void* data, std::size_t size, Clock::time_point until = no_deadline);
  /// What it has sent and nobody has received, also after its end: `most` bytes at most.
  std::string take_rest(std::size_t most);

 private:
  int poll_with_process(std::span<pollfd> descriptors, int milliseconds) const;
  Transfer wait_for(short event, Clock::time_point until) const;
  Transfer broken();

  Descriptor socket_, process_;  ///< without the latter: see poll_with_process()
  bool has_closed_socket_ = false;
  pid_t pid_ = 0;    ///< 0: there is none
  pid_t owner_ = 0;  ///< who has started it; another one has copies of the descriptors after a fork
};

/// "SIGSEGV"
std::string name_of_signal(int number);

}  // namespace muro
