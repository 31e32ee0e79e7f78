// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::fmu {

/// As both versions of the standard number them; `pending` is of FMI 2 alone.
enum class Status { ok, warning, discard, error, fatal, pending };

/// What an instance of an FMU says, from whatever thread: warnings go to the host, and the words about an error are
/// kept for its message.
class MessageLog {
 public:
  /// `name`: of the robot. `all`: also what is no warning.
  MessageLog(Host& host, std::string name, bool all) : host_(&host), name_(std::move(name)), all_(all) {}
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;

  bool logs_all() const { return all_; }
  /// A line that says by itself where it comes from.
  void pass_on(LogLevel level, std::string_view line);
  void say(Status status, std::string_view text);
  /// What was said last about an error or a discarded step; then it is forgotten.
  std::string take_reason();
  /// From now on nothing is said: the host may be gone.
  void close();

 private:
  static constexpr int most_messages = 100;

  std::mutex mutex_;
  Host* host_;
  std::string name_, reason_;
  bool all_;
  int said_ = 0;
};

}  // namespace muro::fmu
